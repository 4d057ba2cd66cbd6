// SPDX-License-Identifier: MIT
// envlight-scenes OUTPUT_FOLDER: writes the sample scenes, each as a model (.osgb) and a scene description (.envlight).
#include "Scene.h"

#include <osgDB/FileUtils>

#include <exception>
#include <iostream>

int main(int argc, char** argv)
{
    if (argc != 2 || argv[1][0] == '-') {
        std::cerr << "usage: envlight-scenes OUTPUT_FOLDER\n";
        return 2;
    }
    const std::string folder = argv[1];
    try {
        if (!osgDB::makeDirectory(folder)) throw std::runtime_error("cannot make the folder " + folder);
        for (const auto& make : {scenes::chess, scenes::atrium, scenes::cornell, scenes::livingRoom, scenes::street,
                                 scenes::swing, scenes::materialSpheres})
            make().write(folder);
    } catch (const std::exception& error) {
        std::cerr << "envlight-scenes: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
