// SPDX-License-Identifier: MIT
// Random and quasi-random numbers, the same on every machine.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

namespace osgEnvLight
{

/** Every bit of the result depends on every bit of x [Steele et al. 2014, SplitMix64]. */
inline std::uint64_t mixBits(std::uint64_t x)
{
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

/** In [0,1), from the upper 53 bits. */
inline double unitInterval(std::uint64_t bits)
{
    return double(bits >> 11) * 0x1p-53;
}

/** The points of one sample, two coordinates at a time. Independent: SplitMix64 pairs. Scrambled: each pair of dimensions is a
 * (0,2)-sequence in base 2, Sobol's first two dimensions, with Owen's scrambling by hashes and the samples' order shuffled
 * from pair to pair [Burley 2020]; every seed is an independent scrambling, so that means over seeds are unbiased and their
 * spread is an honest standard error.*/
class RandomPoints
{
  public:
    RandomPoints(std::uint64_t seed, std::uint32_t index, bool scrambled) : _seed(seed), _index(index), _scrambled(scrambled) {}

    glm::dvec2 square()
    {
        const std::uint64_t key = mixBits(_seed + ++_dimension * 0xd1342543de82ef95u);
        if (!_scrambled) {
            const std::uint64_t x = mixBits(key + _index * 0xaf251af3b0f025b5u);
            return {unitInterval(x), unitInterval(mixBits(x))};
        }
        const std::uint32_t i = scramble(reversed(_index), std::uint32_t(key));
        const std::uint32_t x = scramble(reversed(i), std::uint32_t(key >> 32));
        const std::uint32_t y = scramble(reversed(sobol2(reversed(i))), std::uint32_t(mixBits(key)));
        // Half a step more keeps 0 out.
        return {(reversed(x) + 0.5) * 0x1p-32, (reversed(y) + 0.5) * 0x1p-32};
    }
    double number() { return square().x; }

  private:
    static std::uint32_t reversed(std::uint32_t x)
    {
        x = (x << 16) | (x >> 16);
        x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
        x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
        x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
        return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
    }

    // Owen's scrambling of bit-reversed digits: each bit is flipped by a hash of those below it [Laine, Karras 2011; constants
    // of Vegdahl 2021].
    static std::uint32_t scramble(std::uint32_t x, std::uint32_t seed)
    {
        x ^= x * 0x3d20adeau;
        x += seed;
        x *= (seed >> 16) | 1u;
        x ^= x * 0x05526c56u;
        x ^= x * 0x53a22864u;
        return x;
    }

    // Sobol's second dimension: direction numbers of the polynomial x + 1.
    static std::uint32_t sobol2(std::uint32_t i)
    {
        std::uint32_t result = 0;
        for (std::uint32_t v = 0x80000000u; i; i >>= 1, v ^= v >> 1)
            if (i & 1u) result ^= v;
        return result;
    }

    std::uint64_t _seed;
    std::uint64_t _dimension = 0;
    std::uint32_t _index;
    bool _scrambled;
};

}  // namespace osgEnvLight
