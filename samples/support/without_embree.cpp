// SPDX-License-Identifier: MIT
// Stands in for a program that the build has no ray tracer for.
#include <iostream>

int main()
{
    std::cerr << ENVLIGHT_PROGRAM ": built without its ray tracer; install Embree and TBB (libembree-dev, libtbb-dev) and build again\n";
    return 1;
}
