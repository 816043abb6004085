#include "experiments.h"

#include <cstdio>
#include <cstdlib>

namespace relief::experiments {

const std::vector<Entry>& experiments()
{
    static const std::vector<Entry> all = {
        {"E-01", zDecode},
        {"E-02", bumpScale},
        {"E-03", heightDerivatives},
        {"E-04", bakedNormalMap},
        {"E-05", normalizing},
        {"E-06", normalBlends},
        {"E-07", triplanarMethods},
        {"E-08", triplanarWeights},
        {"E-09", tangentFrames},
        {"E-10", derivatives},
        {"E-11", levelForms},
        {"E-12", filters},
        {"E-13", weightPrecision},
        {"E-14", mipGeneration},
        {"E-15", minifiedSpecular},
        {"E-16", normalStorage},
        {"E-17", spanPerspective},
        {"E-18", attributeSetup},
        {"E-19", reciprocal},
        {"E-20", exponentials},
        {"E-21", srgb},
        {"E-22", lightingModels},
        {"E-23", lights},
        {"E-24", depth},
        {"E-25", supersampling},
        {"E-26", halfInterpolants},
        {"E-27", tileSizes},
        {"E-28", lanes},
        {"E-29", threads},
        {"E-30", leaveOut},
        {"E-31", visibilityAndFresnel},
        {"E-32", snapping},
        {"E-33", litScene},
    };
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
