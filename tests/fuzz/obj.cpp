// Any bytes as an OBJ file: an error of one line, or a valid mesh.
#include "relief/mesh/obj.h"

#include <cstdlib>

#include "file_in_memory.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const FileInMemory file(data, size);
    const relief::Expected<relief::Mesh> mesh = relief::readObj(file.path());
    if (mesh ? !relief::validate(*mesh).has_value() : mesh.error().message.find('\n') != std::string::npos)
        std::abort();
    return 0;
}
