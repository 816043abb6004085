// The program of `doctor` alone: it is built sooner than relief, which has the command, too.
#include "command_line.h"
#include "doctor/command.h"

int main(int argc, char** argv)
{
    return relief::samples::runProgram(argc, argv, {.doctor = relief::samples::examineMap});
}
