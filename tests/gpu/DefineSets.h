// SPDX-License-Identifier: MIT
// The sets of defines that a program of shaders/pass is compiled with.
#pragma once

#include <string>
#include <vector>

using Defines = std::vector<std::string>;

/** What a text imports, each once, as it comes. */
Defines imported(const std::string& text);

/** A few of its sets, for each commit: of up to 6 defines all subsets; of more: none, each alone, any two, all but one, all. */
std::vector<Defines> someSets(const Defines& defines);

/** All sets that a frame may ask for, and few others. What shades transparent surfaces gets the surface as values: there all sets
 * of the frame's defines meet each kind of material, and the G-buffer's program has all sets of a surface's. */
std::vector<Defines> reachableSets(const Defines& defines);

/** As osg::Shader inserts them, behind #version. */
std::string withDefines(const std::string& text, const Defines& defines);

std::string listOf(const Defines& defines);
