// SPDX-License-Identifier: MIT
#pragma once

#include "Asset.h"

#include <osg/Array>
#include <osg/PrimitiveSet>

#include <map>

namespace osgEnvLight::gltf
{

/** The accessors of a file as arrays: any component type, normalised or not, any stride, sparse or not. Every read is checked
 * against the buffer, numbers against NaN and infinity, and the sum of what is made against the size of the file. An array is
 * made once, however often it is asked for. Faults are thrown with the path of the property that refers to the accessor. */
class Accessors
{
  public:
    explicit Accessors(const Asset& asset);

    std::size_t count(int accessor) const { return _asset.model.accessors[std::size_t(accessor)].count; }

    osg::Vec2Array* vec2(int accessor, const std::string& path) { return shared<osg::Vec2Array>(accessor, 2, path); }
    osg::Vec3Array* vec3(int accessor, const std::string& path) { return shared<osg::Vec3Array>(accessor, 3, path); }
    osg::Vec4Array* vec4(int accessor, const std::string& path) { return shared<osg::Vec4Array>(accessor, 4, path); }

    /** All components in one list; `components` of each element, 0: as many as it has. */
    std::vector<float> floats(int accessor, unsigned components, const std::string& path);
    std::vector<unsigned> integers(int accessor, unsigned components, const std::string& path);

    /** Components of an element: 1 to 4, 9, 16. */
    unsigned components(int accessor) const;

    /** Triangles, lines or points by index. Each has to be below `vertices`. */
    osg::ref_ptr<osg::DrawElements> indices(int accessor, GLenum mode, std::size_t vertices, const std::string& path);

    /** For what is made beside the arrays. Throws where a small file would fill the memory. */
    void spend(std::uint64_t bytes, const std::string& path);

  private:
    struct Elements;
    Elements elements(int accessor, unsigned components, const std::string& path);
    std::vector<double> numbers(int accessor, unsigned components, const std::string& path);
    void applySparse(int accessor, const Elements& base, std::vector<double>& values);
    void checkFits(const Elements& e, std::uint64_t available, const std::string& path) const;

    template <class Array>
    Array* shared(int accessor, unsigned components, const std::string& path)
    {
        osg::ref_ptr<osg::Array>& array = _arrays[{accessor, components}];
        if (!array) array = make<Array>(floats(accessor, components, path), components);
        return static_cast<Array*>(array.get());
    }

    template <class Array>
    static osg::ref_ptr<osg::Array> make(const std::vector<float>& values, unsigned components)
    {
        osg::ref_ptr<Array> array = new Array(osg::Array::BIND_PER_VERTEX, unsigned(values.size() / components));
        for (std::size_t i = 0; i < values.size(); ++i) (*array)[i / components].ptr()[i % components] = values[i];
        return array;
    }

    const Asset& _asset;
    std::map<std::pair<int, unsigned>, osg::ref_ptr<osg::Array>> _arrays;
    std::uint64_t _budget;
};

}  // namespace osgEnvLight::gltf
