// SPDX-License-Identifier: MIT
#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/ReaderWriter>
#include <osgDB/Registry>
#include <osgDB/fstream>

#include "Scene.h"

namespace
{

/** glTF 2.0 for osgDB; see Scene.h for what is read and MaterialNames.h for what becomes of materials. */
class ReaderWriterGLTF : public osgDB::ReaderWriter
{
  public:
    ReaderWriterGLTF()
    {
        supportsExtension("gltf", "glTF 2.0 model");
        supportsExtension("glb", "binary glTF 2.0 model");
        supportsOption("keepYUp", "Leave +Y up: without it, the model is turned to +Z up");
    }

    const char* className() const override { return "glTF 2.0 Reader"; }

    ReadResult readObject(std::istream& in, const Options* options) const override { return readNode(in, options); }
    ReadResult readObject(const std::string& file, const Options* options) const override { return readNode(file, options); }

    ReadResult readNode(std::istream& in, const Options* options) const override { return read(in, "stream", options); }

    ReadResult readNode(const std::string& file, const Options* options) const override
    {
        if (!acceptsExtension(osgDB::getLowerCaseFileExtension(file))) return ReadResult::FILE_NOT_HANDLED;
        const std::string path = osgDB::findDataFile(file, options);
        if (path.empty()) return notFound(file);
        if (osgDB::fileType(path) == osgDB::DIRECTORY) return file + ": it is a directory, expected a glTF file";
        osgDB::ifstream in(path.c_str(), std::ios::in | std::ios::binary);
        if (!in) return file + ": it cannot be opened for reading";
        osg::ref_ptr<Options> beside = options ? options->cloneOptions() : new Options;
        beside->getDatabasePathList().push_front(osgDB::getFilePath(path));
        return read(in, file, beside);
    }

  private:
    static ReadResult notFound(const std::string& file)
    {
        ReadResult result(ReadResult::FILE_NOT_FOUND);
        result.message() = file + ": it is not there, expected a glTF file";
        return result;
    }

    static ReadResult read(std::istream& in, const std::string& name, const Options* options)
    {
        std::string error;
        const osg::ref_ptr<osg::Node> node = osgEnvLight::gltf::readGltf(in, name, options, error);
        return node ? ReadResult(node.get()) : ReadResult(error);
    }
};

}  // namespace

REGISTER_OSGPLUGIN(gltf, ReaderWriterGLTF)
