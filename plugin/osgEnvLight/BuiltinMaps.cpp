// SPDX-License-Identifier: MIT
// TEMPORARY placeholder so that others can link: to be replaced by the author of BuiltinMaps.
#include <osgEnvLight/BuiltinMaps>
namespace osgEnvLight
{
osg::ref_ptr<osg::Image> createBuiltinMap(const std::string& name)
{
    if (name != "sky" && name != "studio") return nullptr;
    osg::ref_ptr<osg::Image> i = new osg::Image;
    i->allocateImage(128, 64, 1, GL_RGB, GL_FLOAT);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 128; ++x) {
            float* p = reinterpret_cast<float*>(i->data(unsigned(x), unsigned(y)));
            p[0] = p[1] = p[2] = y > 32 ? 1.0f : 0.2f;
        }
    return i;
}
const std::vector<std::string>& builtinMapNames()
{
    static const std::vector<std::string> names = {"sky", "studio"};
    return names;
}
}
