// SPDX-License-Identifier: MIT
// Questions to OpenGL for which a threaded driver would have to wait, in frames after the first.
#include <OnScreen.h>
#include <SceneRenderer.h>

#include <osg/GLExtensions>

#include <dlfcn.h>

#include <atomic>

#include <gtest/gtest.h>

namespace GlCalls_test
{

namespace
{

std::atomic<int> askedIntegers{0};  // threads of other tests ask too
int askedStatus = 0;
decltype(osg::GLExtensions::glCheckFramebufferStatus) driversStatus = nullptr;

GLenum countStatus(GLenum target)
{
    ++askedStatus;
    return driversStatus(target);
}

// Calls of three frames, after three that make what later ones use.
int integersAsked(OnScreen& screen)
{
    screen.draw(3);
    const int before = askedIntegers;
    screen.draw(3);
    return askedIntegers - before;
}

}  // namespace

// In place of the driver's, for every library of this program.
extern "C" __attribute__((visibility("default"))) void glGetIntegerv(GLenum name, GLint* values)
{
    static const auto drivers = reinterpret_cast<void (*)(GLenum, GLint*)>(dlsym(RTLD_NEXT, "glGetIntegerv"));
    ++askedIntegers;
    drivers(name, values);
}

TEST(GlCalls, AFrameAsksNothingOfTheDriver)
{
    osg::ref_ptr<osgEnvLight::LitScene> lit = makeLit(makeMap(64, 32, sixDirectionColor).get());
    lit->addChild(makeSphere(osg::Vec3d(), 1.0, 32));
    OnScreen plain(lit->getChild(0), osgViewer::Viewer::SingleThreaded);
    const int plainly = integersAsked(plain);

    OnScreen screen(lit.get(), osgViewer::Viewer::SingleThreaded);
    EXPECT_EQ(plainly, integersAsked(screen));
    EXPECT_GT(askedIntegers, 0);  // it counts

    osg::GLExtensions& ext = *screen.state().get<osg::GLExtensions>();
    driversStatus = ext.glCheckFramebufferStatus;
    ext.glCheckFramebufferStatus = countStatus;
    screen.draw(3);
    EXPECT_EQ(0, askedStatus);
    lit->getSettings()->atlasLights = 32;  // another target
    screen.draw(1);
    EXPECT_GT(askedStatus, 0);
    ext.glCheckFramebufferStatus = driversStatus;
}

}  // namespace GlCalls_test
