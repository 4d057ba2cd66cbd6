// SPDX-License-Identifier: MIT
#pragma once

#include <osgDB/InputStream>
#include <osgDB/OutputStream>

#include <string>
#include <utility>
#include <vector>

/** A list of names with their texts, and the version of the software that wrote it. A reader skips names that it does not know,
 * so a later version may add names anywhere. In text files the list is a block that begins with the word Version and stops at the
 * word End (an XML stream does not show its brackets), in binary files it begins with a mark.*/
class NamedTexts
{
  public:
    static constexpr int currentVersion = 2;
    /** First byte of the list in a binary file. Version 0 wrote a bool, 0 or 1, at that place. */
    static constexpr unsigned char binaryMark = 2;

    /** Of the file; 0 for files without a list. */
    int version = 0;
    std::vector<std::pair<std::string, std::string>> pairs;

    void write(osgDB::OutputStream& os) const;
    /** The rest of the list, after the mark. */
    static NamedTexts readBinary(osgDB::InputStream& is);
    /** Without pairs and of version 0 where the file has no list here. */
    static NamedTexts readText(osgDB::InputStream& is);

    /** One osg::WARN about the names that the reader of this class skipped; nothing if there are none. */
    static void reportUnknown(const char* className, const std::vector<std::string>& names);
};
