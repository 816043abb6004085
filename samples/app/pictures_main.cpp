// The program of one stage, and relief_pictures of all of them: their pictures, and what can be said of them. It has no
// window, compiles no stage and grades nothing, so that whoever wants a picture waits for nothing else to be built.
#include "command_line.h"
#include "commands.h"

int main(int argc, char** argv)
{
    using namespace relief::samples;
    return runProgram(
        argc, argv,
        {.list = list, .render = render, .gallery = gallery, .hash = hash, .signature = signature, .explain = explain});
}
