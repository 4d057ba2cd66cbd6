// SPDX-License-Identifier: MIT
// video MODEL [FRAME ...]: a scene under an environment that changes all the time: numbered images, one every thirtieth of a
// second, or, without any, a day made by code, one image whose pixels are written anew for each frame.
#include <osgEnvLight/LitScene>

#include <osg/ImageSequence>
#include <osgDB/ReadFile>
#include <osgViewer/Viewer>

#include <cmath>
#include <iostream>

namespace
{

const int width = 256;
const int height = width / 2;
const double dayLength = 30.0;  // seconds

// The sky at that time of the day, 0 to 1: blue above, reddish about a low sun, dark ground.
void paintDay(osg::Image& image, double time)
{
    const double angle = osg::PI * (0.05 + 0.9 * time);
    const osg::Vec3d sun(std::cos(angle), -0.5 * std::sin(angle), 0.85 * std::sin(angle));
    const double evening = std::exp(-5.0 * sun.z());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double theta = osg::PI * (y + 0.5) / height;  // from the bottom row
            const double phi = 2.0 * osg::PI * (0.5 - (x + 0.5) / width);
            const osg::Vec3d d(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), -std::cos(theta));
            const double toSun = d * sun / sun.length();
            const double glow = std::exp(8.0 * (toSun - 1.0));
            osg::Vec3d c = osg::Vec3d(0.25, 0.45, 1.0) * (d.z() > 0.0 ? 0.9 - 0.6 * d.z() : 0.1);
            c += osg::Vec3d(1.0, 0.5 - 0.2 * evening, 0.25) * (glow * (0.3 + evening));
            if (toSun > std::cos(0.02)) c += osg::Vec3d(1.0, 0.9 - 0.3 * evening, 0.75 - 0.5 * evening) * 900.0;
            float* texel = reinterpret_cast<float*>(image.data(unsigned(x), unsigned(y)));
            for (int k = 0; k < 3; ++k) texel[k] = float(c[k]);
        }
    image.dirty();
}

// Writes the pixels in the update phase of each frame, when no other thread reads them.
class Day : public osg::NodeCallback
{
  public:
    explicit Day(osg::Image* image) : _image(image) {}
    void operator()(osg::Node* node, osg::NodeVisitor* nv) override
    {
        const double time = nv->getFrameStamp() ? nv->getFrameStamp()->getSimulationTime() : 0.0;
        paintDay(*_image, std::fmod(time / dayLength, 1.0));
        traverse(node, nv);
    }

  private:
    const osg::ref_ptr<osg::Image> _image;
};

osg::ref_ptr<osg::ImageSequence> playFrames(int count, char** names)
{
    osg::ref_ptr<osg::ImageSequence> sequence = new osg::ImageSequence;
    for (int i = 0; i < count; ++i) sequence->addImageFile(names[i]);
    sequence->setLength(count / 30.0);
    sequence->setLoopingMode(osg::ImageStream::LOOPING);
    sequence->play();
    return sequence;
}

}  // namespace

int main(int argc, char** argv)
{
    osg::ref_ptr<osg::Node> scene = argc > 1 ? osgDB::readRefNodeFile(argv[1]) : nullptr;
    if (!scene) {
        std::cerr << "usage: video MODEL [FRAME ...]\n";
        return 2;
    }
    osg::ref_ptr<osgEnvLight::LitScene> lit = new osgEnvLight::LitScene;
    if (argc > 2) {
        lit->getEnvironmentMap()->setImage(playFrames(argc - 2, argv + 2).get());
    } else {
        osg::ref_ptr<osg::Image> image = new osg::Image;
        image->allocateImage(width, height, 1, GL_RGB, GL_FLOAT);
        paintDay(*image, 0.0);
        lit->getEnvironmentMap()->setImage(image.get());
        lit->addUpdateCallback(new Day(image.get()));
    }
    lit->addChild(scene);

    osgViewer::Viewer viewer;
    viewer.setUseConfigureAffinity(false);  // else the video is decoded on the processor that draws
    viewer.setSceneData(lit);
    return viewer.run();
}
