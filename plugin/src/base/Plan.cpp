// SPDX-License-Identifier: MIT
#include <osgEnvLight/Plan>

#include <algorithm>
#include <sstream>

namespace osgEnvLight
{

namespace
{

const PassReport* find(const std::vector<PassReport>& passes, const std::string& name)
{
    const auto found = std::find_if(passes.begin(), passes.end(), [&](const PassReport& r) { return r.pass == name; });
    return found == passes.end() ? nullptr : &*found;
}

}  // namespace

bool Plan::runs(const std::string& pass) const
{
    const PassReport* report = find(passes, pass);
    return report && report->runs;
}

std::string Plan::reason(const std::string& pass) const
{
    const PassReport* report = find(passes, pass);
    return report ? report->reason : "";
}

std::string Plan::explain() const
{
    std::ostringstream out;
    for (const PassReport& r : passes) out << r.pass << ": " << (r.runs ? "" : "off, ") << r.reason << "\n";
    return out.str();
}

}  // namespace osgEnvLight
