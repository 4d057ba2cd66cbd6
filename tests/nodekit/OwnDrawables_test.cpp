// SPDX-License-Identifier: MIT
// Drawables of the application's own that call OpenGL themselves.
#include <SceneRenderer.h>

#include <osg/Drawable>
#include <osg/Program>

#include <gtest/gtest.h>

#include <set>

namespace OwnDrawables_test
{

using osgEnvLight::LitScene;

namespace
{

// A square of side 2 in the plane y = 0, facing -y, by evaluators: OpenGL refuses them unless texture unit 0 is active.
class Patch : public osg::Drawable
{
  public:
    Patch() { setInitialBound(osg::BoundingBox(-1, 0, -1, 1, 0, 1)); }

    void drawImplementation(osg::RenderInfo&) const override
    {
        GLint unit = 0;
        glGetIntegerv(GL_ACTIVE_TEXTURE, &unit);
        units.insert(unit - GL_TEXTURE0);
        const GLfloat corners[2][2][3] = {{{-1, 0, -1}, {1, 0, -1}}, {{-1, 0, 1}, {1, 0, 1}}};
        glPushAttrib(GL_ENABLE_BIT | GL_EVAL_BIT);
        glEnable(GL_AUTO_NORMAL);
        glEnable(GL_MAP2_VERTEX_3);
        glMap2f(GL_MAP2_VERTEX_3, 0, 1, 3, 2, 0, 1, 6, 2, &corners[0][0][0]);
        glMapGrid2f(4, 0, 1, 4, 0, 1);
        glEvalMesh2(GL_FILL, 0, 4, 0, 4);
        glPopAttrib();
    }

    mutable std::set<int> units;  // that were active

  protected:
    ~Patch() override = default;
};

// Lit by a map of radiance 1, of which a ball hides little.
osg::ref_ptr<LitScene> sceneOf(Patch* patch)
{
    osg::ref_ptr<LitScene> lit = makeLit(makeMap(64, 32, [](const osg::Vec3d&) { return osg::Vec3d(1, 1, 1); }).get());
    lit->addChild(makeSphere(osg::Vec3d(8, 3, 0), 1.0, 16));
    lit->addChild(patch);
    return lit;
}

}  // namespace

TEST(OwnDrawables, FindTheFirstTextureUnitActive)
{
    SceneRenderer renderer(64, 64);
    NotifyCatcher notify;
    for (const bool displayList : {false, true}) {
        const osg::ref_ptr<Patch> patch = new Patch;
        patch->setUseDisplayList(displayList);
        const osg::ref_ptr<LitScene> lit = sceneOf(patch);
        renderer.lookAt(osg::Vec3d(0, -6, 0), osg::Vec3d());
        const Picture p = renderer.render(lit, 3);
        EXPECT_EQ(std::set<int>{0}, patch->units) << displayList;
        EXPECT_NEAR(p.color(32, 32)[0], 0.604, 0.01) << displayList;  // .8, OpenGL's material where none is set, decoded
    }
    EXPECT_EQ("", notify.text());
}

// What is drawn after the composite.
TEST(OwnDrawables, FindTheFirstTextureUnitActiveBehindTheComposite)
{
    SceneRenderer renderer(64, 64);
    NotifyCatcher notify;
    const osg::ref_ptr<Patch> patch = new Patch;
    patch->setUseDisplayList(false);
    const osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT, "void main() { gl_FragColor = vec4(0.0, 1.0, 0.0, 1.0); }"));
    patch->getOrCreateStateSet()->setAttribute(program);
    const osg::ref_ptr<LitScene> lit = sceneOf(patch);
    renderer.lookAt(osg::Vec3d(0, -6, 0), osg::Vec3d());
    const Picture p = renderer.render(lit, 3);
    EXPECT_EQ(std::set<int>{0}, patch->units);
    EXPECT_EQ(1.0f, p.color(32, 32)[1]);
    EXPECT_EQ("", notify.text());
}

}  // namespace OwnDrawables_test
