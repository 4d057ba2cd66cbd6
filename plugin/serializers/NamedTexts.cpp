// SPDX-License-Identifier: MIT
#include "NamedTexts.h"

#include <osg/Notify>

namespace
{

const char* const listWord = "Version";
const char* const endWord = "End";

}  // namespace

void NamedTexts::write(osgDB::OutputStream& os) const
{
    if (os.isBinary()) {
        os << binaryMark << currentVersion << unsigned(pairs.size());
        for (const auto& [name, text] : pairs) {
            os.writeWrappedString(name);
            os.writeWrappedString(text);
        }
        return;
    }
    os << os.PROPERTY(listWord) << currentVersion << os.BEGIN_BRACKET << std::endl;
    for (const auto& [name, text] : pairs) {
        os << os.PROPERTY(name.c_str());
        os.writeWrappedString(text);
        os << std::endl;
    }
    os << os.PROPERTY(endWord) << std::endl << os.END_BRACKET << std::endl;
}

NamedTexts NamedTexts::readBinary(osgDB::InputStream& is)
{
    NamedTexts list;
    unsigned count = 0;
    is >> list.version >> count;
    for (unsigned i = 0; i < count && !is.getException(); ++i) {
        list.pairs.emplace_back();
        is.readWrappedString(list.pairs.back().first);
        is.readWrappedString(list.pairs.back().second);
    }
    return list;
}

NamedTexts NamedTexts::readText(osgDB::InputStream& is)
{
    NamedTexts list;
    if (!is.matchString(listWord)) return list;
    is >> list.version >> is.BEGIN_BRACKET;
    while (!is.getException()) {
        std::pair<std::string, std::string> pair;
        is >> pair.first;
        if (pair.first == "}") return list;  // somebody has removed the last line
        if (pair.first == endWord || pair.first.empty()) break;
        is.readWrappedString(pair.second);
        list.pairs.push_back(pair);
    }
    is >> is.END_BRACKET;
    return list;
}

void NamedTexts::reportUnknown(const char* className, const std::vector<std::string>& names)
{
    if (names.empty()) return;
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "'" : ", '") + name + "'";
    OSG_WARN << "osgEnvLight: " << className << " in this file has properties that this version does not know: " << text
             << "; they are skipped" << std::endl;
}
