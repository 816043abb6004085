// The program that has no report: it knows their names and options, for `report --help` and for what is no report.
#include "command_line.h"

int main(int argc, char** argv)
{
    return relief::samples::runProgram(argc, argv, {});
}
