#include "experiments.h"

#include <cstdio>
#include <cstdlib>

namespace relief::experiments {

std::string number(double value, int digits)
{
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, "%.*f", digits, value);
    return buffer;
}

double Row::fact(const std::string& factName) const
{
    for (const Fact& f : outcome.facts) {
        if (f.name == factName) return f.value;
    }
    return NAN;
}

const Row& Rows::operator()(const std::string& name, const std::string& parameter) const
{
    for (const Row& row : all) {
        if (row.name == name && row.parameter == parameter) return row;
    }
    std::fprintf(stderr, "experiments: a finding speaks of a variant that there is not: %s %s\n", name.c_str(),
                 parameter.c_str());
    std::abort();
}

}  // namespace relief::experiments
