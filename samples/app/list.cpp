// list: every stage of the program, and what can be set in it.
#include <cstdio>

#include <nlohmann/json.hpp>

#include "commands.h"

namespace relief::samples {

namespace {

nlohmann::json describe(const Property& p)
{
    nlohmann::json value = p.value.x;
    if (p.components > 1) {
        value = nlohmann::json::array();
        for (int i = 0; i < p.components; ++i) value.push_back(p.value[i]);
    }
    static constexpr const char* kKinds[] = {"number", "vector", "color", "toggle", "choice"};
    nlohmann::json all = {{"name", p.name},       {"kind", kKinds[static_cast<std::size_t>(p.kind)]},
                          {"default", value},     {"minimum", p.minimum},
                          {"maximum", p.maximum}, {"meaning", p.meaning}};
    if (!p.choices.empty()) all["choices"] = p.choices;
    return all;
}

nlohmann::json describe(const Stage& stage)
{
    nlohmann::json properties = nlohmann::json::array();
    for (const Property& p : stage.properties()) properties.push_back(describe(p));
    return {{"id", stage.id},           {"stem", stage.stem},      {"title", stage.title}, {"tutorial", stage.tutorial},
            {"section", stage.section}, {"properties", properties}};
}

}  // namespace

Expected<void> list(bool json)
{
    if (json) {
        nlohmann::json all = nlohmann::json::array();
        for (const Stage& stage : allStages()) all.push_back(describe(stage));
        std::printf("%s\n", all.dump(2).c_str());
        return {};
    }
    std::string tutorial;
    for (const Stage& stage : allStages()) {
        if (stage.tutorial != tutorial) std::printf("%s%s\n", tutorial.empty() ? "" : "\n", stage.tutorial.c_str());
        tutorial = stage.tutorial;
        std::printf("  %s  %-26s %s\n", stage.id.c_str(), stage.stem.c_str(), std::string(stage.news).c_str());
    }
    return {};
}

}  // namespace relief::samples
