// SPDX-License-Identifier: MIT
// The sets of defines that a program of shaders/pass is compiled with.
#pragma once

#include <string>
#include <vector>

using Defines = std::vector<std::string>;

/** What a text imports, each once, as it comes. */
Defines imported(const std::string& text);

/** A covering array of strength 3: sets of about half of the defines, until any three have occurred in each of the eight ways.
 * None of fewer than three. */
std::vector<Defines> tripleSets(const Defines& defines);

/** A few of its sets, for each commit: of up to 5 defines all subsets; of more: none, each alone, all but one, all, and any
 * three in each of the eight ways. */
std::vector<Defines> someSets(const Defines& defines);

/** The sets that a frame may ask for, and few others.
 * A pass over the picture: all sets, with no lobe or all lobes; and someSets().
 * The G-buffer's program: each kind of surface with each texture mode, and none, one or all of the other defines; and someSets().
 * The program of transparent surfaces: both, and all sets of the frame's defines with two kinds of surface.
 * The program of surfaces that an application moves is one of these two: the surfaces of the first with the define of each.*/
std::vector<Defines> reachableSets(const Defines& defines);

/** As osg::Shader inserts them, behind #version. */
std::string withDefines(const std::string& text, const Defines& defines);

std::string listOf(const Defines& defines);
