// Drives Chromium through its WebDriver (W3C), by curl: what a person does, with real keys.
#pragma once

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include <signal.h>
#include <unistd.h>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "contents.h"

class WebDriver
{
public:
    using Json = nlohmann::json;

    // Files that pages save go to this folder.
    explicit WebDriver(const std::filesystem::path& itsFolder, bool isDark = false) : folder(itsFolder)
    {
        start();
        Json arguments = {"--headless=new",         "--no-sandbox",
                          "--disable-gpu",          "--disable-dev-shm-usage",
                          "--window-size=1280,900", "--user-data-dir=" + (folder / "profile").string()};
        if (isDark) arguments.push_back("--force-dark-mode");
        const Json capabilities = {
            {"capabilities",
             {{"alwaysMatch",
               {{"browserName", "chrome"},
                {"goog:chromeOptions",
                 {{"binary", RELIEF_CHROMIUM},
                  {"args", arguments},
                  {"prefs",
                   {{"download.default_directory", folder.string()}, {"download.prompt_for_download", false}}}}}}}}}};
        const Json answer = call("POST", "/session", capabilities);
        REQUIRE(answer.contains("sessionId"));
        session = "/session/" + answer["sessionId"].get<std::string>();
    }
    ~WebDriver()
    {
        if (!session.empty()) call("DELETE", session);
        if (driver > 0) kill(driver, SIGTERM);
    }
    WebDriver(const WebDriver&) = delete;
    WebDriver& operator=(const WebDriver&) = delete;

    void open(const std::filesystem::path& page)
    {
        call("POST", session + "/url", {{"url", "file://" + page.string()}});
    }

    // What the script returns.
    Json run(const std::string& script, const Json& arguments = Json::array())
    {
        return call("POST", session + "/execute/sync", {{"script", script}, {"args", arguments}});
    }
    std::string text(const std::string& script)
    {
        const Json value = run(script);
        return value.is_string() ? value.get<std::string>() : value.dump();
    }

    // Presses keys one after the other; U+E012 ... E015 are the arrows.
    void press(const std::vector<std::string>& keys)
    {
        Json actions = Json::array();
        for (const std::string& key : keys) {
            actions.push_back({{"type", "keyDown"}, {"value", key}});
            actions.push_back({{"type", "keyUp"}, {"value", key}});
        }
        call("POST", session + "/actions",
             {{"actions", {{{"type", "key"}, {"id", "keyboard"}, {"actions", actions}}}}});
    }

    // Until the script returns true, ten seconds at most.
    bool wait(const std::string& script)
    {
        for (int i = 0; i < 200; ++i) {
            if (run(script) == Json(true)) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
        return false;
    }

private:
    // The driver picks a port, and says which.
    void start()
    {
        const std::string log = (folder / "driver.log").string(), number = (folder / "driver.pid").string();
        const std::string command =
            "'" RELIEF_CHROMEDRIVER "' --port=0 >'" + log + "' 2>&1 </dev/null & echo $! >'" + number + "'";
        REQUIRE(std::system(command.c_str()) == 0);
        std::ifstream(number) >> driver;
        for (int i = 0; i < 200 && port.empty(); ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
            const std::string words = contents(log), mark = "started successfully on port ";
            const std::size_t at = words.find(mark);
            if (at != std::string::npos && words.find('\n', at) != std::string::npos)
                port = words.substr(at + mark.size(),
                                    words.find_first_not_of("0123456789", at + mark.size()) - at - mark.size());
        }
        REQUIRE_FALSE(port.empty());
    }

    // One request of the protocol, and the value of its answer.
    Json call(const std::string& method, const std::string& path, const Json& body = Json())
    {
        const std::filesystem::path request = folder / "request.json", answer = folder / "answer.json";
        std::ofstream(request) << (body.is_null() ? "{}" : body.dump());
        const std::string command = "'" RELIEF_CURL "' -s --max-time 60 -X " + method +
                                    " -H 'Content-Type: application/json' --data '@" + request.string() + "' -o '" +
                                    answer.string() + "' http://127.0.0.1:" + port + path;
        if (std::system(command.c_str()) != 0) return Json();
        const Json json = Json::parse(contents(answer), nullptr, false);
        return json.is_object() && json.contains("value") ? json["value"] : Json();
    }

    std::filesystem::path folder;
    std::string port, session;
    int driver = 0;
};
