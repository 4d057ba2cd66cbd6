// SPDX-License-Identifier: MIT
#include "Browser.h"

#include <fstream>
#include <sstream>

#include "Process.h"

namespace
{

// Answers go to the page that holds the frames.
std::string probed(const std::string& page, const std::string& probe)
{
    const std::string first =
        "<script>window.exceptions = []; addEventListener('error', (e) => exceptions.push(String(e.message)));</script>\n";
    const std::string last = "<script>addEventListener('load', () => { const findings = (() => {" + probe +
                             "})(); findings.exceptions = exceptions; parent.postMessage({frame: window.name, findings}, '*'); "
                             "});</script>\n";
    std::string result = page;
    result.insert(result.rfind("</body>"), last);
    result.insert(result.find("<title>"), first);
    return result;
}

std::string frames(const std::vector<std::string>& names, const std::vector<int>& widths)
{
    std::string html =
        "<!DOCTYPE html><title>frames</title><pre id=\"findings\"></pre>\n<script>\nconst all = {};\n"
        "addEventListener('message', (e) => { all[e.data.frame] = e.data.findings; document.getElementById('findings')"
        ".textContent = JSON.stringify(all).replace(/[<>&\\u0080-\\uffff]/g, (c) => '\\\\u' + "
        "c.charCodeAt(0).toString(16).padStart(4, '0')); });\n</script>\n";
    for (const std::string& name : names)
        for (int width : widths)
            html += "<iframe src=\"" + name + "/probed.html\" name=\"" + name + " " + std::to_string(width) +
                    "\" style=\"border: 0; width: " + std::to_string(width) + "px; height: 900px\"></iframe>\n";
    return html;
}

}  // namespace

std::string browserCommand()
{
    std::string path = runProgram({"sh", "-c", "command -v chromium"}).out;
    while (!path.empty() && path.back() == '\n') path.pop_back();
    return path;
}

Findings probePages(const std::string& folder, const std::vector<std::string>& names, const std::vector<int>& widths,
                    const std::string& probe)
{
    for (const std::string& name : names)
        std::ofstream(folder + "/" + name + "/probed.html") << probed(readFile(folder + "/" + name + "/index.html"), probe);
    std::ofstream(folder + "/frames.html") << frames(names, widths);
    const TemporaryFolder profile;
    const Outcome outcome =
        runProgram({browserCommand(), "--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr", "--v=0",
                    "--user-data-dir=" + profile.file("profile"), "--window-size=1500,1000", "--virtual-time-budget=20000",
                    "--dump-dom", "file://" + folder + "/frames.html"});
    Findings findings;
    const std::string start = "<pre id=\"findings\">";
    const size_t from = outcome.out.find(start) + start.size();
    const std::string text = outcome.out.substr(from, outcome.out.find("</pre>") - from);
    const nlohmann::json all = nlohmann::json::parse(text, nullptr, false);
    if (all.is_object())
        for (auto found = all.begin(); found != all.end(); ++found) {
            const size_t space = found.key().rfind(' ');
            findings.pages[{found.key().substr(0, space), std::stoi(found.key().substr(space + 1))}] = *found;
        }
    std::istringstream lines(outcome.err);
    for (std::string line; std::getline(lines, line);)
        if (line.find("CONSOLE") != std::string::npos) findings.console.push_back(line);
    return findings;
}
