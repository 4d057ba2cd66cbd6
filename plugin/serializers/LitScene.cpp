// SPDX-License-Identifier: MIT
#include "NamedTexts.h"

#include <osgEnvLight/LitScene>

#include <osg/Notify>
#include <osgDB/ObjectWrapper>

#include <locale>
#include <sstream>

namespace
{

using osgEnvLight::EnvironmentMap;
using osgEnvLight::HomeView;
using osgEnvLight::LitScene;

const char* const homeViewName = "homeView";

// Eye, target, up and fovy: ten numbers.
std::string textOf(const HomeView& view)
{
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out.precision(17);  // enough for every double
    for (const osg::Vec3d& v : {view.eye, view.target, view.up}) out << v[0] << ' ' << v[1] << ' ' << v[2] << ' ';
    out << view.fovy;
    return out.str();
}

bool parse(const std::string& text, HomeView& view)
{
    std::istringstream in(text);
    in.imbue(std::locale::classic());
    for (osg::Vec3d* v : {&view.eye, &view.target, &view.up}) in >> (*v)[0] >> (*v)[1] >> (*v)[2];
    in >> view.fovy;
    return bool(in) && view.fovy > 0.0 && view.fovy < 180.0;
}

/** The environment map as version 0 wrote it, after a list of the node's own properties. Version 0 has no list, but its binary
 * files begin with the bool of the map, which a list's mark can't be taken for.*/
class MapAfterList : public osgDB::ObjectSerializer<LitScene, EnvironmentMap>
{
  public:
    MapAfterList() : ObjectSerializer("EnvironmentMap", nullptr, &LitScene::getEnvironmentMap, &LitScene::setEnvironmentMap) {}

    bool read(osgDB::InputStream& is, osg::Object& object) override
    {
        LitScene& lit = static_cast<LitScene&>(object);
        if (!is.isBinary()) {
            apply(NamedTexts::readText(is), lit);
            return ObjectSerializer::read(is, object);
        }
        unsigned char mark = 0;
        is >> mark;
        bool present = mark != 0;
        if (mark >= NamedTexts::binaryMark) {
            apply(NamedTexts::readBinary(is), lit);
            is >> present;
        }
        if (present) lit.setEnvironmentMap(is.readObjectOfType<EnvironmentMap>().get());
        return true;
    }

    bool write(osgDB::OutputStream& os, const osg::Object& object) override
    {
        NamedTexts list;
        const auto& view = static_cast<const LitScene&>(object).getHomeView();
        if (view) list.pairs.emplace_back(homeViewName, textOf(*view));
        list.write(os);
        return ObjectSerializer::write(os, object);
    }

  private:
    static void apply(const NamedTexts& list, LitScene& lit)
    {
        std::vector<std::string> unknown;
        for (const auto& [name, text] : list.pairs) {
            HomeView view;
            if (name != homeViewName)
                unknown.push_back(name);
            else if (parse(text, view))
                lit.setHomeView(view);
            else
                OSG_WARN << "osgEnvLight: homeView is '" << text << "', expected eye, target, up and fovy" << std::endl;
        }
        NamedTexts::reportUnknown("LitScene", unknown);
    }
};

}  // namespace

REGISTER_OBJECT_WRAPPER(osgEnvLight_LitScene, new osgEnvLight::LitScene, osgEnvLight::LitScene,
                        "osg::Object osg::Node osg::Group osgEnvLight::LitScene")
{
    wrapper->addSerializer(new MapAfterList, osgDB::BaseSerializer::RW_OBJECT);
    ADD_OBJECT_SERIALIZER(Settings, osgEnvLight::Settings, NULL);
}
