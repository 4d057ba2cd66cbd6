// SPDX-License-Identifier: MIT
#include <sstream>

#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/ReaderWriter>
#include <osgDB/Registry>
#include <osgDB/fstream>

#include "ExrImage.h"

namespace
{

/** OpenEXR for osgDB. Reads to GL_FLOAT images with the picture's bottom row first; see ExrImage.h for what is read and
 * written. Options for writing: "half" or "float"; without either, GL_FLOAT images are written as float, others as half. */
class ReaderWriterEXR : public osgDB::ReaderWriter
{
  public:
    ReaderWriterEXR()
    {
        supportsExtension("exr", "OpenEXR image");
        supportsOption("half", "Write 16 bit floating point");
        supportsOption("float", "Write 32 bit floating point: the default for GL_FLOAT images");
    }

    const char* className() const override { return "OpenEXR Image Reader/Writer"; }

    ReadResult readObject(std::istream& in, const Options* options) const override { return readImage(in, options); }
    ReadResult readObject(const std::string& file, const Options* options) const override { return readImage(file, options); }

    ReadResult readImage(std::istream& in, const Options*) const override { return read(in, "stream"); }

    ReadResult readImage(const std::string& file, const Options* options) const override
    {
        if (!acceptsExtension(osgDB::getLowerCaseFileExtension(file))) return ReadResult::FILE_NOT_HANDLED;
        const std::string path = osgDB::findDataFile(file, options);
        if (path.empty()) return notFound(file);
        if (osgDB::fileType(path) == osgDB::DIRECTORY) return file + ": it is a directory, expected an OpenEXR file";
        osgDB::ifstream in(path.c_str(), std::ios::in | std::ios::binary);
        if (!in) return file + ": it cannot be opened for reading";
        ReadResult result = read(in, file);
        if (result.validImage()) result.getImage()->setFileName(file);
        return result;
    }

    WriteResult writeObject(const osg::Object& object, std::ostream& out, const Options* options) const override
    {
        const auto* image = dynamic_cast<const osg::Image*>(&object);
        return image ? writeImage(*image, out, options) : WriteResult(WriteResult::FILE_NOT_HANDLED);
    }

    WriteResult writeObject(const osg::Object& object, const std::string& file, const Options* options) const override
    {
        const auto* image = dynamic_cast<const osg::Image*>(&object);
        return image ? writeImage(*image, file, options) : WriteResult(WriteResult::FILE_NOT_HANDLED);
    }

    WriteResult writeImage(const osg::Image& image, std::ostream& out, const Options* options) const override
    {
        return write(image, out, "stream", options);
    }

    WriteResult writeImage(const osg::Image& image, const std::string& file, const Options* options) const override
    {
        if (!acceptsExtension(osgDB::getLowerCaseFileExtension(file))) return WriteResult::FILE_NOT_HANDLED;
        // The file is opened last, so that an image that cannot be written does not cost an older file.
        std::stringstream memory;
        const WriteResult result = write(image, memory, file, options);
        if (!result.success()) return result;
        osgDB::ofstream out(file.c_str(), std::ios::out | std::ios::binary | std::ios::trunc);
        if (!out) return file + ": it cannot be opened for writing";
        out << memory.rdbuf() << std::flush;
        return out ? WriteResult(WriteResult::FILE_SAVED) : WriteResult(file + ": it cannot be written to its end");
    }

  private:
    static ReadResult notFound(const std::string& file)
    {
        ReadResult result(ReadResult::FILE_NOT_FOUND);
        result.message() = file + ": it is not there, expected an OpenEXR file";
        return result;
    }

    static ReadResult read(std::istream& in, const std::string& name)
    {
        std::string error;
        const osg::ref_ptr<osg::Image> image = osgEnvLight::readExr(in, name, error);
        return image ? ReadResult(image) : ReadResult(error);
    }

    static WriteResult write(const osg::Image& image, std::ostream& out, const std::string& name, const Options* options)
    {
        bool half = image.getDataType() != GL_FLOAT;
        std::istringstream words(options ? options->getOptionString() : std::string());
        for (std::string word; words >> word;) {
            if (word == "half") half = true;
            if (word == "float") half = false;
        }
        std::string error;
        if (osgEnvLight::writeExr(image, out, half, error)) return WriteResult::FILE_SAVED;
        return name + ": " + error;
    }
};

}  // namespace

REGISTER_OSGPLUGIN(exr, ReaderWriterEXR)
