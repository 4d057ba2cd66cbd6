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

/** All sets that a frame may ask for, and few others: without a surface's defines all, lobes together. Of those of a surface each kind
 * with each way that its texture joins, and one or all of the others. What shades transparent surfaces has all sets of the frame's with
 * two kinds of surface. */
std::vector<Defines> reachableSets(const Defines& defines);

/** As osg::Shader inserts them, behind #version. */
std::string withDefines(const std::string& text, const Defines& defines);

std::string listOf(const Defines& defines);
