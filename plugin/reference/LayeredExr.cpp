// SPDX-License-Identifier: MIT
#include <reference/LayeredExr>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <cstdio>
#include <stdexcept>

namespace osgEnvLight
{

namespace
{

void addChannels(Imf::Header& header, Imf::FrameBuffer& buffer, const std::string& prefix, const Picture& p, int count)
{
    static const char* const names[] = {"R", "G", "B", "A"};
    for (int k = 0; k < count; ++k) {
        const std::string name = prefix + names[k];
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        // Our rows run upwards, OpenEXR's down.
        char* top = const_cast<char*>(reinterpret_cast<const char*>(p.at(0, p.height - 1) + k));
        const auto row = -ptrdiff_t(4 * sizeof(float)) * p.width;
        buffer.insert(name, Imf::Slice(Imf::FLOAT, top, 4 * sizeof(float), size_t(row)));
    }
}

}  // namespace

void writeLayeredExr(const std::string& fileName, const Picture& picture,
                     const std::vector<std::pair<std::string, const Picture*>>& layers,
                     const std::vector<std::pair<std::string, std::string>>& attributes)
{
    try {
        Imf::Header header(picture.width, picture.height);
        Imf::FrameBuffer buffer;
        addChannels(header, buffer, "", picture, 4);
        for (const auto& [name, layer] : layers) addChannels(header, buffer, name + ".", *layer, 3);
        for (const auto& [name, text] : attributes) header.insert(name, Imf::StringAttribute(text));
        Imf::OutputFile file(fileName.c_str(), header);
        file.setFrameBuffer(buffer);
        file.writePixels(picture.height);
    } catch (const std::exception& error) {
        std::remove(fileName.c_str());
        throw std::runtime_error(fileName + ": can't be written: " + error.what());
    }
}

}  // namespace osgEnvLight
