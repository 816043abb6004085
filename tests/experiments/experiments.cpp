#include "experiments.h"

#include <cstdio>
#include <cstdlib>

namespace relief::experiments {

const std::vector<Entry>& experiments()
{
    static const std::vector<Entry> all = {{"E-01", zDecode},
                                           {"E-07", triplanarMethods},
                                           {"E-08", triplanarWeights},
                                           {"E-09", tangentFrames},
                                           {"E-19", reciprocal},
                                           {"E-20", exponentials},
                                           {"E-21", srgb},
                                           {"E-23", lights},
                                           {"E-24", depth},
                                           {"E-27", tileSizes},
                                           {"E-28", lanes},
                                           {"E-29", threads},
                                           {"E-32", snapping}};
    return all;
}

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
