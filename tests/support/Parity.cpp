// SPDX-License-Identifier: MIT
#include "Parity.h"

#include <memory>

namespace parity
{

using glsl::vec3;

Tolerance within(double relative, double absolute)
{
    return [=](const std::vector<glsl::vec4>&, double exact) { return relative * std::abs(exact) + absolute; };
}

GlContext& context()
{
    static const std::unique_ptr<GlContext> shared(new GlContext);
    return *shared;
}

glm::vec4 toFloat(const glsl::vec4& v)
{
    return glm::vec4(float(v.x), float(v.y), float(v.z), float(v.w));
}

std::vector<vec3> directions(int count, unsigned seed)
{
    std::vector<vec3> result = {vec3(1, 0, 0), vec3(-1, 0, 0), vec3(0, 1, 0), vec3(0, -1, 0), vec3(0, 0, 1), vec3(0, 0, -1)};
    for (double e : {1e-2, 1e-4, 1e-6, -1e-3, -1e-5})
        for (double sign : {1.0, -1.0}) {
            const double c = sign * std::sqrt(1.0 - e * e);
            for (const vec3& d : {vec3(e, 0, c), vec3(0, e, c), vec3(c, e, 0), vec3(c, 0, e), vec3(0, c, e)}) result.push_back(d);
        }
    testmaths::Random random(seed);
    while (int(result.size()) < count) result.push_back(random.direction());
    return result;
}

void expectParity(const std::vector<std::string>& files, const std::string& body, const std::vector<Row>& rows,
                  const Function& exact, const Tolerance& tolerance, const std::vector<GlContext::Texture>& textures)
{
    std::vector<std::vector<glm::vec4>> columns(rows.at(0).size());
    for (const Row& row : rows)
        for (size_t k = 0; k < columns.size(); ++k) columns[k].push_back(row.at(k));
    const std::vector<glm::vec4> gpu = context().evaluate(files, body, columns, textures);
    double worst = 0.0;
    std::string where;
    for (size_t i = 0; i < rows.size(); ++i) {
        const std::vector<glsl::vec4> inputs(rows[i].begin(), rows[i].end());
        const glsl::vec4 cpu = exact(inputs);
        for (int c = 0; c < 4; ++c) {
            ASSERT_TRUE(std::isfinite(cpu[c])) << body << " row " << i;
            const double allowed = tolerance(inputs, cpu[c]);
            const double difference = std::abs(double(gpu[i][c]) - cpu[c]);
            const double share = difference == 0.0 ? 0.0 : difference / allowed;
            if (share <= worst) continue;  // a NaN goes on
            worst = std::isnan(share) ? INFINITY : share;
            where = "component " + std::to_string(c) + ": " + std::to_string(gpu[i][c]) + ", exact " + std::to_string(cpu[c]) +
                    ", difference " + std::to_string(difference / 1e-6) + "e-6, allowed " + std::to_string(allowed / 1e-6) +
                    "e-6, inputs";
            for (const glsl::vec4& v : inputs) {
                char text[128];
                snprintf(text, sizeof(text), " (%.9g %.9g %.9g %.9g)", v.x, v.y, v.z, v.w);
                where += text;
            }
        }
    }
    EXPECT_LE(worst, 1.0) << body << "\n" << where << "\non " << context().renderer();
}

}  // namespace parity
