// relief_pictures: what the program of one stage does (stage_main.cpp), of all of them, and the gallery.
#include "command_line.h"
#include "commands.h"

int main(int argc, char** argv)
{
    using namespace relief::samples;
    return runProgram(
        argc, argv,
        {.list = list, .render = render, .gallery = gallery, .hash = hash, .signature = signature, .explain = explain});
}
