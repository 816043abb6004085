// An experiment asks what an approximation costs and what it saves: variants of one computation, each with its error
// against an exact reference beside its run time. `relief report error` measures them (report_error.cpp); the tests
// hold the errors to reference values that were computed without the engine.
//
// Whatever takes time is a function here, so that counting instructions does not wait for errors.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace relief::experiments {

// Largest and root of the mean square, in the experiment's unit, over so many samples.
struct Error
{
    double max = 0.0, rms = 0.0;
    std::int64_t count = 0;
};

class ErrorSum
{
public:
    // Not a number counts as infinite.
    void add(double error, double weight = 1.0)
    {
        const double size = std::isnan(error) ? HUGE_VAL : std::abs(error);
        sum.max = std::fmax(sum.max, size);
        squares += weight * size * size;
        weights += weight;
        ++sum.count;
    }
    Error result() const { return {sum.max, weights > 0.0 ? std::sqrt(squares / weights) : 0.0, sum.count}; }

private:
    Error sum;
    double squares = 0.0, weights = 0.0;
};

// A number besides the error that a variant's row shows, such as bytes or fetches. All variants of an experiment have
// the same, in the same order.
struct Fact
{
    std::string name;
    double value;
};

struct Outcome
{
    Outcome(Error e, std::vector<Fact> f = {}) : error(e), facts(std::move(f)) {}  // from an error alone, too
    Error error;
    std::vector<Fact> facts;
    std::optional<std::uint64_t> imageHash;  // of a frame
};

// What is timed: run() does it once, for so many items.
struct Work
{
    std::function<void()> run;
    double items = 0.0;
};

struct Variant
{
    std::string name, parameter;
    std::function<Outcome()> outcome;
    Work work;            // a frame, or data that stays in the first-level cache
    Work streaming = {};  // the same on data that does not; may be missing
    int threads = 1;
    bool isCounted = true;  // false: has instructions that the program which counts them may not have
};

// A measured number beside the one that it is to be.
struct Check
{
    std::string what;
    double expected;
    std::function<double()> measured;
    double tolerance;
    bool isBound = false;  // at most `expected`, and no tolerance

    bool holds(double number) const { return isBound ? number <= expected : std::abs(number - expected) <= tolerance; }
};

// A variant, measured: nanoseconds per item.
struct Row
{
    std::string name, parameter;
    Outcome outcome;
    double fastest = 0.0, median = 0.0, deviation = 0.0;  // the last: median absolute deviation
    std::optional<double> streaming;                      // fastest
    std::optional<double> instructions;
    bool isOnFront = false;  // no rival beats it in error and time together

    double fact(const std::string& factName) const;  // NaN: there is none of that name
};

class Rows
{
public:
    std::vector<Row> all;
    const Row& operator()(const std::string& name, const std::string& parameter = "") const;  // ends if there is none
};

// Which variants do the same, so that one can be better than another.
enum class Rivals
{
    all,
    ofOneName,
    ofOneParameter
};

struct Experiment
{
    std::string id, title;  // "E-01"
    std::string question;   // what is compared with what, in plain words
    std::string item;       // what a time is of: "decode"
    std::string unit;       // of the errors: "degrees"
    Rivals rivals = Rivals::all;
    std::vector<Variant> variants;
    std::vector<Check> checks;
    std::function<std::string(const Rows&)> finding;  // what came out, with the numbers of the rows
};

// How thorough: the report takes all samples, tests in every build take fewer.
struct Effort
{
    bool full = true;
    int samples(int all, int few) const { return full ? all : few; }
};

struct Entry
{
    const char* id;
    Experiment (*make)(Effort);
};
const std::vector<Entry>& experiments();

inline constexpr double kRadians = std::numbers::pi / 180.0,
                        kDegrees = 180.0 / std::numbers::pi;  // in one of the other

// In [0, 1), the same on every machine.
inline double uniform(std::mt19937& random)
{
    return static_cast<double>(random()) / 4294967296.0;
}

// The angle between two vectors of any lengths, in degrees; exact where acos of a dot product is not.
template <class V>
double degreesBetween(const V& a, const V& b)
{
    const auto unit = [](const V& v, double sign, const V& w) {
        const double vLength = std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
        const double wLength = std::sqrt(w.x * w.x + w.y * w.y + w.z * w.z);
        const double x = v.x / vLength + sign * w.x / wLength, y = v.y / vLength + sign * w.y / wLength,
                     z = v.z / vLength + sign * w.z / wLength;
        return std::sqrt(x * x + y * y + z * z);
    };
    return 2.0 * std::atan2(unit(a, -1.0, b), unit(a, 1.0, b)) * kDegrees;
}

}  // namespace relief::experiments
