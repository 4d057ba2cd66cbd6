# SPDX-License-Identifier: MIT
# cmake -DROOT=shaders -DFILES=a;b -DOUTPUT=x.cpp -P EmbedShaders.cmake
# Writes one table of (name, text). Bytes go through hex because file(READ) loses ';', '[' and '\'.
set(table "// Generated from shaders/ by plugin/cmake/EmbedShaders.cmake.\n#include \"gl/ShaderLibrary.h\"\n\nnamespace osgEnvLight\n{\n\nconst EmbeddedShader embeddedShaders[] = {\n")
foreach(file IN LISTS FILES)
    file(RELATIVE_PATH name ${ROOT} ${file})
    file(READ ${file} hex HEX)
    string(REGEX REPLACE "0a" "0a|" hex "${hex}")
    string(REGEX REPLACE "\\|$" "" hex "${hex}")
    string(REGEX REPLACE "([0-9a-f][0-9a-f])" "\\\\x\\1" text "${hex}")
    string(REPLACE "|" "\"\n     \"" text "${text}")
    string(APPEND table "    {\"${name}\",\n     \"${text}\"},\n")
endforeach()
string(APPEND table "};\n\nconst unsigned numEmbeddedShaders = sizeof(embeddedShaders) / sizeof(embeddedShaders[0]);\n\n} // namespace osgEnvLight\n")
file(WRITE ${OUTPUT} "${table}")
