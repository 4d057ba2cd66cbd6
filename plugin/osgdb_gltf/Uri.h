// SPDX-License-Identifier: MIT
#pragma once

#include <osgDB/Options>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace osgEnvLight::gltf
{

/** The bytes that a URI stands for: a data URI, or a file by its path relative to `options`' data base path, percent-encoded.
 * Absolute paths, and schemes other than data: and file:, are refused.
 * @param least, most  bytes that are read; a data URI of more than `most` is cut
 * Throws std::runtime_error with what was found instead. */
std::vector<unsigned char> readUri(const std::string& uri, const osgDB::Options* options, std::uint64_t least,
                                   std::uint64_t most);

/** Of base64 text with or without padding; nothing if it is not base64. */
std::optional<std::vector<unsigned char>> decodeBase64(const std::string& text, std::size_t from);

}  // namespace osgEnvLight::gltf
