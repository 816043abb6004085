#include "common/import_options.h"

#include <utility>

#include "relief/decimal.h"

namespace relief::samples {

namespace {

template <class Value>
using Choices = std::vector<std::pair<const char*, Value>>;

// Sets `chosen` to the value of that name.
template <class Value>
Expected<void> choose(const std::string& option, const std::string& name, const Choices<Value>& choices, Value& chosen)
{
    std::string names;
    for (const auto& [known, value] : choices) {
        if (name == known) {
            chosen = value;
            return {};
        }
        names += (names.empty() ? "" : ", ") + std::string(known);
    }
    return fail("--import " + option + ": '" + name + "' is not one of " + names);
}

Expected<void> apply(const std::string& option, ImportSettings& s)
{
    using Storage = ImportSettings::Storage;
    using FromGreyscale = ImportSettings::FromGreyscale;
    const std::size_t equals = option.find('=');
    const std::string name = option.substr(0, equals);
    const std::string value = equals == std::string::npos ? "" : option.substr(equals + 1);
    if (name == "storage") {
        const Choices<Storage> all = {{"rgb", Storage::rgb}, {"dxt5nm", Storage::dxt5nm}, {"dxt5", Storage::dxt5}};
        return choose(option, value, all, s.storage);
    }
    if (name == "filter") {
        const Choices<NormalFilter> all = {{"smooth", NormalFilter::smooth}, {"sobel", NormalFilter::sobel}};
        return choose(option, value, all, s.normalFilter);
    }
    if (name == "heights") {
        const Choices<FromGreyscale> all = {
            {"automatic", FromGreyscale::automatic}, {"yes", FromGreyscale::yes}, {"no", FromGreyscale::no}};
        return choose(option, value, all, s.fromGreyscale);
    }
    if (name == "fade") return choose(option, value, Choices<bool>{{"on", true}, {"off", false}}, s.fadeOutMips);
    if (name == "bumpiness") {
        const std::optional<float> number = parseDecimal(value);
        if (!number || !(*number >= 0.0f && *number <= kMaxBumpiness)) {
            return fail("--import " + option + ": '" + value + "' is not a number from 0 to 16");
        }
        s.bumpiness = *number;
        return {};
    }
    return fail("--import " + option + ": unknown; write storage=, bumpiness=, filter=, heights= or fade= and a value");
}

}  // namespace

Expected<ImportSettings> withOptions(ImportSettings settings, const std::vector<std::string>& options)
{
    for (const std::string& option : options) {
        const Expected<void> applied = apply(option, settings);
        if (!applied) return tl::unexpected(applied.error());
    }
    return settings;
}

}  // namespace relief::samples
