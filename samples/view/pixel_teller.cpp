#include "view/pixel_teller.h"

#include <cerrno>
#include <cstdio>

#include <sys/socket.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "live/toolchain.h"
#include "picture_command.h"

namespace relief::samples {

namespace {

using Json = nlohmann::json;

std::string wordOf(const Json& number)
{
    if (number.is_string()) return number.get<std::string>();
    if (number.is_boolean()) return number.get<bool>() ? "true" : "false";
    if (number.is_number_integer()) return std::to_string(number.get<long long>());
    char text[32];
    std::snprintf(text, sizeof text, "%.7g", number.get<double>());
    return text;
}

std::string wordsOf(const Json& numbers)
{
    std::string words;
    for (const Json& number : numbers) words += (words.empty() ? "" : "  ") + wordOf(number);
    return words;
}

// Of the fragment program's events, those that have a value.
std::vector<PixelStep> stepsOf(const Json& fragment, int pixel)
{
    std::vector<PixelStep> steps;
    for (const Json& event : fragment.value("events", Json::array())) {
        if (event["event"] != "value" && event["event"] != "sample") continue;
        PixelStep step;
        step.line = event["line"];
        step.file = event["file"];
        step.code = event.value("code", "");
        step.function = event["function"];
        step.name = event["name"];
        for (std::size_t i = 0; i < 4; ++i) step.values[i] = wordsOf(event["quad"][i]);
        for (const Json& number : event["quad"][static_cast<std::size_t>(pixel)]) {
            step.isInvalid = step.isInvalid || number.is_string();
        }
        steps.push_back(std::move(step));
    }
    return steps;
}

PixelLife lifeOf(const Json& trace)
{
    PixelLife life;
    life.x = trace["pixel"][0];
    life.y = trace["pixel"][1];
    int covering = 0;
    std::string drawn = "the colour that the target was cleared to";
    for (const Json& draw : trace["draws"]) {
        for (const Json& primitive : draw["primitives"]) {
            for (const Json& piece : primitive["pieces"]) {
                if (!piece.contains("fragment")) continue;
                ++covering;
                const Json& fragment = piece["fragment"];
                bool isDrawn = false;
                for (const Json& sample : fragment["samples"]) isDrawn = isDrawn || sample["verdict"] == "drawn";
                if (!isDrawn || !fragment["ran"].get<bool>()) continue;
                life.steps = stepsOf(fragment, life.inQuad());
                drawn = "triangle " + std::to_string(primitive["number"].get<int>()) + " of draw " +
                        std::to_string(draw["number"].get<int>()) + ", " + draw["mesh"].get<std::string>();
                if (!fragment["targets"].empty()) drawn += ", returned " + wordsOf(fragment["targets"][0]["returned"]);
            }
        }
    }
    life.summary = (covering == 1 ? "1 triangle covers it" : std::to_string(covering) + " triangles cover it") +
                   "; what one sees: " + drawn;
    return life;
}

}  // namespace

void PixelTeller::ask(const live::StageSource& source, const live::Look& look, int version, int x, int y)
{
    const std::string command = traceCommand(live::programPath(), source, "--json --pixel -", look);
    const std::string wanted = command + " #" + std::to_string(version);
    if (wanted != running) {
        stop();
        start(command);
        running = wanted;
    }
    if (lives.count({x, y}) != 0 || (waits && asked == Point(x, y))) return;
    wish = {x, y};
    send();
}

const PixelLife* PixelTeller::told(int x, int y) const
{
    const auto found = lives.find({x, y});
    return found == lives.end() ? nullptr : &found->second;
}

bool PixelTeller::poll()
{
    bool news = false;
    char buffer[65536];
    while (process.stream() >= 0 && waits) {
        const ssize_t size = ::read(process.stream(), buffer, sizeof buffer);
        if (size < 0 && errno == EINTR) continue;
        if (size < 0) break;  // nothing more yet
        if (size == 0) {      // it ended: what it wrote last is why
            complaint =
                received.empty() ? "the process that tells of pixels has ended; choose the pixel again" : received;
            stop();
            return true;
        }
        received.append(buffer, static_cast<std::size_t>(size));
        const std::size_t end = received.find('\n');
        if (end == std::string::npos || received[0] != '{') continue;
        take(received.substr(0, end));
        received.erase(0, end + 1);
        waits = false;
        news = true;
        send();
    }
    return news;
}

void PixelTeller::take(const std::string& line)
{
    const Json trace = Json::parse(line, nullptr, false);
    complaint.clear();
    if (trace.is_discarded()) {
        complaint = "what the process said cannot be read: " + line.substr(0, 80);
    } else if (trace.contains("error")) {
        complaint = trace["error"].get<std::string>();
    } else {
        if (lives.size() > 2000) lives.clear();  // some 20 KB each
        lives[*asked] = lifeOf(trace);
    }
}

void PixelTeller::send()
{
    if (process.stream() < 0 || waits || !wish) return;
    const std::string line = std::to_string(wish->first) + "," + std::to_string(wish->second) + "\n";
    if (::send(process.stream(), line.data(), line.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(line.size())) return;
    asked = wish;
    wish.reset();
    waits = true;
}

void PixelTeller::start(const std::string& command)
{
    Expected<Child> started = Child::start(command);
    if (!started) {
        complaint = started.error().message;
        return;
    }
    process = std::move(*started);
}

void PixelTeller::stop()
{
    process = {};
    waits = false;
    asked.reset();
    wish.reset();
    running.clear();
    received.clear();
    lives.clear();
}

}  // namespace relief::samples
