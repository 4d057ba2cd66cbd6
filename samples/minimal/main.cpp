// SPDX-License-Identifier: MIT
// minimal MODEL [MAP]: an existing OpenSceneGraph viewer, and the three lines that light its scene.
#include <osgEnvLight/LitScene>

#include <osgDB/ReadFile>
#include <osgViewer/Viewer>

#include <iostream>

int main(int argc, char** argv)
{
    osg::ref_ptr<osg::Node> scene = argc > 1 ? osgDB::readRefNodeFile(argv[1]) : nullptr;
    if (!scene) {
        std::cerr << "usage: minimal MODEL [MAP]\n";
        return 2;
    }
    osgViewer::Viewer viewer;

    osg::ref_ptr<osgEnvLight::LitScene> lit = new osgEnvLight::LitScene;  // the built-in sky
    if (argc > 2) lit = new osgEnvLight::LitScene(osgDB::readRefImageFile(argv[2]));
    lit->addChild(scene);
    viewer.setSceneData(lit);

    return viewer.run();
}
