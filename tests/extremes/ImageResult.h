/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osg/Image>

#include <string>

#include <gtest/gtest.h>

/** What a reader of images gives for a text that it is told is of a file. */
struct ImageResult {
    std::string file;
    osg::ref_ptr<osg::Image> image;
    std::string error;
};

/** The one promise about every input: an image, or one line that names the file. */
inline void expectImageOrError(const ImageResult& result)
{
    ASSERT_EQ(result.image.valid(), result.error.empty()) << result.error;
    if (result.image) return;
    EXPECT_EQ(result.error.rfind(result.file + ": ", 0), 0u) << result.error;
    EXPECT_EQ(result.error.find('\n'), std::string::npos) << result.error;
}

inline void expectError(const ImageResult& result, const std::string& part)
{
    expectImageOrError(result);
    EXPECT_FALSE(result.image.valid());
    EXPECT_NE(result.error.find(part), std::string::npos) << "found: " << result.error << "\nexpected: " << part;
}
