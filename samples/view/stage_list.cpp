#include "view/stage_list.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <sstream>

namespace relief::samples {

namespace {

// The head of a stage's file: "// 1.12 Bump scale: ..." and "// New: ...".
Listed listed(const live::StageSource& source)
{
    Listed stage{source, source.stem, ""};
    std::ifstream file(source.path);
    const std::string number = "// " + source.id + " ", news = "// New: ";
    for (std::string line; std::getline(file, line) && line.starts_with("//");) {
        if (line.starts_with(number)) stage.title = line.substr(number.size(), line.find(':') - number.size());
        if (line.starts_with(news)) stage.news = line.substr(news.size());
    }
    return stage;
}

std::string lower(std::string text)
{
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

}  // namespace

const std::vector<Listed>& listedStages()
{
    static const std::vector<Listed> all = [] {
        std::vector<Listed> list;
        for (const live::StageSource& source : live::stageSources()) list.push_back(listed(source));
        return list;
    }();
    return all;
}

bool matches(const Listed& stage, const std::string& search)
{
    const std::string text = lower(stage.source.id + " " + stage.title + " " + stage.news + " " + stage.source.stem +
                                   " " + stage.source.tutorial);
    std::istringstream words(lower(search));
    for (std::string word; words >> word;) {
        if (text.find(word) == std::string::npos) return false;
    }
    return true;
}

std::string pageOf(const live::StageSource& source)
{
    return live::sampleFolder() + "/../docs/" + source.folder + "/" + source.stem + ".md";
}

std::string goldenOf(const live::StageSource& source)
{
    return live::sampleFolder() + "/../tests/golden/" + source.folder + "/" + source.stem + ".png";
}

}  // namespace relief::samples
