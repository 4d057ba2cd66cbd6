// SPDX-License-Identifier: MIT
// shaders [MAP]: an application's own shaders, lit. Grass is 4096 instances of one blade in the wind, a flag has waves: their
// vertices are moved by functions of this program's. The colours of a ball are of its own fragment shader.
#include <osgEnvLight/LightShader>
#include <osgEnvLight/LitScene>
#include <osgEnvLight/Material>
#include <osgEnvLight/SurfaceProgram>

#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/ShapeDrawable>
#include <osgDB/ReadFile>
#include <osgUtil/SmoothingVisitor>
#include <osgViewer/Viewer>

namespace
{

const int bladesAside = 64;

const char* const grass = R"(
uniform float osg_SimulationTime;
float hash(int i) { return fract(sin(float(i)) * 43758.5453); }
void envlightVertex(inout vec4 vertex, inout vec3 normal)
{
    int column = gl_InstanceID % 64;
    int row = gl_InstanceID / 64;
    vec2 place = (vec2(column, row) + vec2(hash(gl_InstanceID), hash(gl_InstanceID + 7777))) / 64.0 * 6.0 - 3.0;
    float angle = 6.2832 * hash(gl_InstanceID + 1234);
    mat2 turn = mat2(cos(angle), sin(angle), -sin(angle), cos(angle));
    vertex.z *= 0.6 + 0.8 * hash(gl_InstanceID + 99);
    vertex.xy = turn * vertex.xy + place;
    vertex.x += 0.5 * vertex.z * vertex.z * sin(2.0 * osg_SimulationTime + place.x + 0.5 * place.y);
    normal.xy = turn * normal.xy;
}
)";

const char* const flag = R"(
uniform float osg_SimulationTime;
void envlightVertex(inout vec4 vertex, inout vec3 normal)
{
    float phase = 5.0 * vertex.x - 4.0 * osg_SimulationTime;
    vertex.y += 0.12 * vertex.x * sin(phase);
    normal = normalize(vec3(0.12 * (sin(phase) + 5.0 * vertex.x * cos(phase)), -1.0, 0.0));
}
)";

const char* const checksVertex = R"(#version 330 compatibility
out vec3 model;
out vec3 position;
out vec3 normal;
void main()
{
    model = gl_Vertex.xyz;
    position = vec3(gl_ModelViewMatrix * gl_Vertex);
    normal = gl_NormalMatrix * gl_Normal;
    gl_Position = ftransform();
}
)";

const char* const checksFragment = R"(#version 330 compatibility
in vec3 model;
in vec3 position;
in vec3 normal;
vec4 envlightLit(vec3 position, vec3 normal, vec4 baseColor, float metalness, float roughness);
void main()
{
    vec3 cell = floor(6.0 * model);
    bool odd = mod(cell.x + cell.y + cell.z, 2.0) > 0.5;
    gl_FragColor = envlightLit(position, normal, odd ? vec4(0.9, 0.7, 0.3, 1.0) : vec4(0.05, 0.1, 0.3, 1.0), odd ? 1.0 : 0.0, 0.25);
}
)";

// A sheet of columns x rows of cells from corner on, along two sides.
osg::ref_ptr<osg::Geometry> sheet(const osg::Vec3& corner, const osg::Vec3& across, const osg::Vec3& up, int columns, int rows)
{
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    const osg::ref_ptr<osg::DrawElementsUInt> indices = new osg::DrawElementsUInt(GL_TRIANGLES);
    for (int y = 0; y <= rows; ++y)
        for (int x = 0; x <= columns; ++x)
            vertices->push_back(corner + across * (float(x) / float(columns)) + up * (float(y) / float(rows)));
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const auto at = [&](int i, int j) { return unsigned((y + j) * (columns + 1) + x + i); };
            for (unsigned i : {at(0, 0), at(1, 0), at(1, 1), at(0, 0), at(1, 1), at(0, 1)}) indices->push_back(i);
        }
    const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(vertices);
    geometry->addPrimitiveSet(indices);
    geometry->setUseVertexBufferObjects(true);
    osgUtil::SmoothingVisitor::smooth(*geometry);
    return geometry;
}

// Its bound holds what its function makes of it.
osg::ref_ptr<osg::Node> moved(osg::ref_ptr<osg::Geometry> geometry, const char* function, const osg::Vec3& color,
                              const osg::BoundingBox& bound)
{
    geometry->setInitialBound(bound);
    osg::StateSet& state = *geometry->getOrCreateStateSet();
    state.setAttributeAndModes(osgEnvLight::SurfaceProgram::create(function));
    osgEnvLight::Material::setLambert(state, color);
    return geometry;
}

osg::ref_ptr<osg::Node> checkeredBall()
{
    const osg::ref_ptr<osg::ShapeDrawable> ball = new osg::ShapeDrawable(new osg::Sphere(osg::Vec3(-1.2f, 0, 0.8f), 0.8f));
    const osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(osg::Shader::VERTEX, checksVertex));
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT, checksFragment));
    program->addShader(osgEnvLight::LightShader::create());
    ball->getOrCreateStateSet()->setAttributeAndModes(program);
    return ball;
}

}  // namespace

int main(int argc, char** argv)
{
    osg::ref_ptr<osgEnvLight::LitScene> lit = new osgEnvLight::LitScene;
    if (argc > 1) lit = new osgEnvLight::LitScene(osgDB::readRefImageFile(argv[1]));

    const osg::ref_ptr<osg::Geometry> ground = sheet(osg::Vec3(-3, -3, 0), osg::Vec3(6, 0, 0), osg::Vec3(0, 6, 0), 1, 1);
    osgEnvLight::Material::setLambert(*ground->getOrCreateStateSet(), osg::Vec3(0.12f, 0.09f, 0.05f));
    lit->addChild(ground);
    const osg::ref_ptr<osg::Geometry> blade = sheet(osg::Vec3(-0.02f, 0, 0), osg::Vec3(0.04f, 0, 0), osg::Vec3(0, 0, 0.4f), 1, 4);
    blade->getPrimitiveSet(0)->setNumInstances(bladesAside * bladesAside);
    blade->setUseDisplayList(false);  // they hold no instances
    lit->addChild(moved(blade, grass, osg::Vec3(0.1f, 0.25f, 0.03f), osg::BoundingBox(-3.2f, -3.2f, 0, 3.2f, 3.2f, 0.7f)));
    const osg::ref_ptr<osg::Node> cloth = moved(sheet(osg::Vec3(), osg::Vec3(1.6f, 0, 0), osg::Vec3(0, 0, 1), 48, 8), flag,
                                                osg::Vec3(0.6f, 0.05f, 0.05f), osg::BoundingBox(0, -0.3f, 0, 1.6f, 0.3f, 1));
    const osg::ref_ptr<osg::MatrixTransform> mast = new osg::MatrixTransform(osg::Matrixd::translate(0.8, 0.5, 1.4));
    mast->addChild(cloth);
    mast->addChild(new osg::ShapeDrawable(new osg::Cylinder(osg::Vec3(0, 0, -0.2f), 0.03f, 2.6f)));
    lit->addChild(mast);
    lit->addChild(checkeredBall());
    lit->setHomeView({osg::Vec3d(1, -8, 3), osg::Vec3d(0, 0, 0.8)});

    osgViewer::Viewer viewer;
    viewer.setSceneData(lit);
    return viewer.run();
}
