// The program of one stage: its picture, and what can be said of it. It has no window, compiles no stage and grades
// nothing, so that whoever wants a picture waits for nothing else to be built.
#include "command_line.h"
#include "commands.h"

int main(int argc, char** argv)
{
    using namespace relief::samples;
    return runProgram(argc, argv, {.render = render, .hash = hash, .signature = signature, .explain = explain});
}
