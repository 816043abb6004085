// Any bytes as words of the command line, one a line: exit code 0 or 2, whatever they say. Only commands that write no
// file, at a size of few pixels. The program's main() is compiled under this name.
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

int reliefMain(int argc, char** argv);

extern "C" int LLVMFuzzerInitialize(int*, char***)
{
    const int nowhere = open("/dev/null", O_WRONLY);  // what the commands print; libFuzzer prints to stderr
    dup2(nowhere, STDOUT_FILENO);
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const char* const commands[] = {"list", "hash", "explain", "signature", "render"};
    if (size == 0) return 0;
    const std::string command = commands[data[0] % std::size(commands)];
    std::vector<std::string> words = {"relief", command};
    if (command == "hash" || command == "explain" || command == "render") words.insert(words.end(), {"--size", "4x4"});
    if (command == "render") words.insert(words.end(), {"--output", "/dev/null/no.png"});
    std::string word;
    for (std::size_t i = 1; i < size; ++i) {
        if (data[i] != '\n' && data[i] != 0) word += static_cast<char>(data[i]);
        if (data[i] != '\n' && data[i] != 0 && i + 1 < size) continue;
        words.push_back(word);
        word.clear();
    }
    std::vector<char*> argv;
    for (std::string& w : words) argv.push_back(w.data());
    argv.push_back(nullptr);
    const int code = reliefMain(static_cast<int>(words.size()), argv.data());
    if (code != 0 && code != 2) std::abort();
    return 0;
}
