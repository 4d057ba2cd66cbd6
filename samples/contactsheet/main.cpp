// SPDX-License-Identifier: MIT
// envlight-contact-sheet [--columns N] -o SHEET.png PICTURE...: pictures of equal size side by side.
#include "CommandLine.h"

#include <osg/Image>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

#include <algorithm>

namespace
{

int run(const std::vector<std::string>& names, int columns, const std::string& output)
{
    std::vector<osg::ref_ptr<osg::Image>> pictures;
    for (const std::string& name : names) {
        osg::ref_ptr<osg::Image> image = osgDB::readRefImageFile(name);
        const bool fits = image && image->getPixelFormat() == GL_RGB && image->getDataType() == GL_UNSIGNED_BYTE &&
                          (pictures.empty() || (image->s() == pictures[0]->s() && image->t() == pictures[0]->t()));
        if (!fits) throw std::runtime_error(name + ": expected an RGB picture of the first one's size");
        pictures.push_back(image);
    }
    const int gap = 4;
    const int width = pictures[0]->s();
    const int height = pictures[0]->t();
    const int rows = (int(pictures.size()) + columns - 1) / columns;
    osg::ref_ptr<osg::Image> sheet = new osg::Image;
    sheet->allocateImage(columns * (width + gap) - gap, rows * (height + gap) - gap, 1, GL_RGB, GL_UNSIGNED_BYTE);
    std::fill_n(sheet->data(), sheet->getTotalSizeInBytes(), static_cast<unsigned char>(255));
    for (int i = 0; i < int(pictures.size()); ++i)
        sheet->copySubImage(i % columns * (width + gap), (rows - 1 - i / columns) * (height + gap), 0, pictures[size_t(i)].get());
    if (!osgDB::writeImageFile(*sheet, output)) throw std::runtime_error(output + ": can't be written");
    return 0;
}

}  // namespace

int main(int argc, char** argv)
{
    std::vector<std::string> names;
    std::string output;
    int columns = 3;
    CommandLine line("envlight-contact-sheet", "Puts pictures of equal size side by side.");
    line.add("--columns", columns, "default 3").within(1, 100);
    line.add("-o,--output", output, "SHEET.png").required();
    line.add("PICTURE", names, "of equal size").required();
    return line.run(argc, argv, [&] { return run(names, columns, output); });
}
