// The command line, declared once for all programs: each is one that has functions for some of the commands. Any of
// them knows all commands, so their words, help and messages are the same everywhere.
#pragma once

#include "options.h"
#include "relief/error.h"

namespace relief::samples {

// What a program does for each command. Where it has nothing, the message says how to get the program that has.
struct Program
{
    Expected<void> (*list)(bool json) = nullptr;
    Expected<void> (*render)(const RenderOptions& options, const std::string& output) = nullptr;
    Expected<void> (*renderScene)(const RenderOptions& options, const std::string& output) = nullptr;
    Expected<void> (*renderAtEverySave)(const RenderOptions& options, const std::string& output) = nullptr;
    Expected<void> (*newStage)(const std::string& path, const std::string& from) = nullptr;
    Expected<void> (*gallery)(const std::string& folder, const std::string& shard, int threads) = nullptr;
    Expected<void> (*view)(const ViewOptions& options) = nullptr;
    Expected<void> (*hash)(const RenderOptions& options) = nullptr;
    Expected<void> (*signature)(const RenderOptions& options, const std::string& binormal) = nullptr;
    Expected<void> (*explain)(const RenderOptions& options, bool json) = nullptr;
    Expected<void> (*trace)(const TraceOptions& options) = nullptr;
    Expected<void> (*bench)(const std::vector<std::string>& arguments) = nullptr;
    Expected<void> (*benchStages)(const BenchOptions& options) = nullptr;
    Expected<void> (*benchLive)(const LiveBenchOptions& options) = nullptr;
    Expected<void> (*benchPeer)(const PeerOptions& options) = nullptr;
    Expected<void> (*importEnvironment)(const ImportEnvironmentOptions& options) = nullptr;
    Expected<void> (*exercise)(const std::string& name) = nullptr;
    Expected<int> (*checkExercise)(const std::string& file) = nullptr;  // 1: it is not solved
    Expected<int> (*grade)(const GradeOptions& options) = nullptr;      // 1: one is not solved
    void (*renderSubmission)(const std::string& file) = nullptr;        // does not return
    Expected<int> (*check)(const CheckOptions& options) = nullptr;      // 1: pictures differ
    Expected<int> (*doctor)(const DoctorOptions& options) = nullptr;    // 1: something is wrong with it
    const char* reportName = "";
    Expected<void> (*report)(const ReportOptions& options) = nullptr;  // of that name
};

// What a main() returns: 0, or 2 after one line on stderr; of `check` 1 where pictures differ, of `doctor` where a
// map has a fault.
int runProgram(int argc, char** argv, const Program& program);

}  // namespace relief::samples
