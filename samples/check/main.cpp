// The program of `check`.
#include "check/check.h"
#include "command_line.h"

int main(int argc, char** argv)
{
    return relief::samples::runProgram(argc, argv, {.check = relief::samples::check::run});
}
