// SPDX-License-Identifier: MIT
// Pictures of the reference, kept from run to run under a hash of all that they
// are made from.
#pragma once

#include <metrics/Picture>
#include <reference/Reference>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace suite
{

/** FNV-1a, 64 bits, of the values given to it in turn. */
class ContentHash
{
  public:
    void bytes(const void* data, size_t size);
    void text(const std::string& text);
    template <class T>
    void value(T v)
    {
        static_assert(std::is_arithmetic<T>::value || std::is_enum<T>::value, "padding has no value");
        bytes(&v, sizeof v);
    }
    /** Elements without padding: vectors of floats, of doubles, of integers. */
    template <class T>
    void elements(const std::vector<T>& v)
    {
        value(v.size());
        bytes(v.data(), v.size() * sizeof(T));
    }

    void camera(const osg::Matrixd& view, const osg::Matrixd& projection, int width, int height);
    void map(const osgEnvLight::RadianceMap& map, double rotation, double intensity);
    void options(const osgEnvLight::ReferenceOptions& options);
    void scene(const osgEnvLight::TriangleScene& scene);
    /** The content of a file. Throws std::runtime_error if it can't be read. */
    void file(const std::string& name);

    std::uint64_t get() const { return _hash; }

  private:
    void material(const osgEnvLight::SurfaceMaterial& material);
    void emitter(const osgEnvLight::Emitter& emitter);

    std::uint64_t _hash = 14695981039346656037u;
};

/** A folder of sets of pictures. A set that is damaged or of another version is
 * made again, and what can't be written is not kept.*/
class ReferenceCache
{
  public:
    using Pictures = std::vector<osgEnvLight::Picture>;

    explicit ReferenceCache(const std::string& folder);

    /** What is kept under the key; else it is made, and kept. */
    Pictures get(std::uint64_t key, const std::function<Pictures()>& make);

    /** Where a key's pictures lie. */
    std::string fileName(std::uint64_t key) const;

  private:
    std::string _folder;
};

}  // namespace suite
