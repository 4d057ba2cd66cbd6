// SPDX-License-Identifier: MIT
// Questions to OpenGL for which a threaded driver would have to wait, in frames after the first.
#include <OnScreen.h>
#include <SceneRenderer.h>

#include <osg/GLExtensions>
#include <osg/MatrixTransform>

#include <dlfcn.h>

#include <atomic>

#include <gtest/gtest.h>

namespace GlCalls_test
{

namespace
{

std::atomic<int> askedIntegers{0};  // threads of other tests ask too
std::atomic<int> madeTextures{0};
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

extern "C" __attribute__((visibility("default"))) void glGenTextures(GLsizei count, GLuint* names)
{
    static const auto drivers = reinterpret_cast<void (*)(GLsizei, GLuint*)>(dlsym(RTLD_NEXT, "glGenTextures"));
    madeTextures += int(count);
    drivers(count, names);
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

// Also while something moves, whose shadow maps are drawn anew: with maps and probes about the view, or without.
TEST(GlCalls, AFrameMakesNoTextures)
{
    for (const bool showsLittle : {true, false}) {
        const osg::ref_ptr<osgEnvLight::LitScene> lit = makeLit(makeMap(64, 32, sixDirectionColor).get());
        osgEnvLight::Settings& s = *lit->getSettings();
        s.atlasLights = 16;
        s.atlasSize = 32;
        s.bounce = osgEnvLight::Settings::BOUNCE_PROBES;
        s.bounceProbes = fewestProbes;
        lit->addChild(makeSphere(osg::Vec3d(), 1.0, 16));
        if (showsLittle) lit->addChild(makeBox(osg::Vec3d(999, 0, 0), osg::Vec3d(1000, 1, 1)));
        const osg::ref_ptr<osg::MatrixTransform> moved = new osg::MatrixTransform;
        moved->addChild(makeBox(osg::Vec3d(-0.2, -1.5, -0.2), osg::Vec3d(0.2, -1.2, 0.2)));
        lit->addChild(moved);
        SceneRenderer renderer(64, 64);
        renderer.lookAt(osg::Vec3d(0, -6, 0), osg::Vec3d(), osg::Vec3d(0, 0, 1), 40.0);
        const auto draw = [&](int frames, bool moves) {
            for (int i = 0; i < frames; ++i) {
                if (moves) moved->setMatrix(osg::Matrixd::translate(0.01 * i, 0, 0));
                renderer.render(lit, 1);
            }
        };
        const auto hasProbes = [&] {
            const std::string probes = lit->plan().reason("links");
            return lit->plan().runs("points") && showsLittle == (probes.find("about the view") != std::string::npos);
        };
        for (const bool moves : {false, true}) {
            draw(60, moves);
            for (int i = 0; i < 2000 && !hasProbes(); ++i) draw(1, moves);
            draw(10, moves);
            EXPECT_TRUE(hasProbes()) << lit->plan().explain();
            const int before = madeTextures;
            EXPECT_GT(before, 0);
            draw(10, moves);
            EXPECT_EQ(before, madeTextures) << showsLittle << moves;
        }
    }
}

}  // namespace GlCalls_test
