// Reports: measurements of this machine, written into a folder as text, table and plot. What they have in common.
#pragma once

#include "options.h"
#include "relief/error.h"

namespace relief::samples {

// The lines that a report begins with: title, the command that made it, the machine, the compiler and the commit.
std::string reportHead(const std::string& title, const ReportOptions& options);
std::string reportCommit();

// Writes a file into the report's folder, which is made if it is missing.
Expected<void> writeReport(const ReportOptions& options, const std::string& file, const std::string& text);

// Runs docs/report/SCRIPT.gnuplot, with `settings` ("a=1; b=2") before it, in the report's folder, where it finds the
// tables, and writes PLOT.svg. And whether that is possible.
Expected<void> plotReport(const ReportOptions& options, const std::string& script, const std::string& plot,
                          const std::string& settings);
Expected<void> checkPlotting();

// What is being done, on one line that the next replaces; only on a terminal. Empty: nothing any more.
void showProgress(const std::string& line);

}  // namespace relief::samples
