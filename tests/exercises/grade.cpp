// `grade`: a class's files, and what hostile ones come to. Each of these tries something that would harm or cheat if
// the sandbox had a hole.
#include <algorithm>
#include <cstdlib>
#include <fstream>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "along_v.h"
#include "contents.h"
#include "grader/submission.h"
#include "live_command.h"

namespace {

using namespace relief;
using namespace relief::samples::grader;
namespace fs = std::filesystem;

// Where there is none, these tests fail, unless they are to be left out.
bool hasSandbox()
{
    const Expected<void> checked = checkSandbox();
    if (!checked && std::getenv("RELIEF_WITHOUT_SANDBOX") != nullptr) return false;
    REQUIRE_MESSAGE(checked.has_value(),
                    (checked ? "" : checked.error().message + "; or set RELIEF_WITHOUT_SANDBOX=1"));
    return true;
}

// The right answer, which does something else first.
std::string hostile(const std::string& statement, const std::string& includes)
{
    return answerWith("        const float2 dv", "        " + statement + "\n        const float2 dv", includes);
}

// A class with this one file of mallory's: what becomes of it.
struct Case
{
    TemporaryFolder folder;
    nlohmann::json grade;

    explicit Case(const std::string& text, const std::string& options = "")
    {
        fs::create_directories(folder / "class/mallory");
        fs::create_directories(folder / "class/ada");
        folder.write("class/mallory/1.08a.cpp", text);
        folder.write("secret.txt", "the answers\n");
        const Outcome outcome = runCommand(folder, "grade class " + options);
        CHECK(outcome.code == 1);
        std::ifstream file(folder / "class-grades/grades.json");
        grade = nlohmann::json::parse(file).at(0);
        CHECK(grade["solved"] == false);
        CHECK(contents(folder / "class/mallory/1.08a.cpp") == text);
        CHECK(contents(folder / "secret.txt") == "the answers\n");
    }
    std::string verdict() const { return grade["verdict"]; }
    std::string sentence() const { return grade["sentence"]; }
};

}  // namespace

TEST_CASE("grade: a class of four: solved, wrong twice with the same text, and not compiled")
{
    if (!hasSandbox()) return;
    const TemporaryFolder folder;
    for (const char* name : {"ada", "bob", "eve"}) fs::create_directories(folder / "class" / name);
    folder.write("class/ada/mine.cpp", "// Exercise 1.08a\n" + alongV().answer);
    folder.write("class/bob/1.08a.cpp", answerWith("(v1 - v2)", "(v2 - v1)"));
    folder.write("class/eve/1.08a.cpp", answerWith("(v1 - v2)", "(v2  -  v1)"));
    folder.write("class/=dan_1.08a.cpp", answerWith("v1 - v2", "<b>v1 - v3"));
    folder.write("class/notes.txt", "no file of anybody's\n");
    fs::create_symlink(folder / "class/ada/mine.cpp", folder / "class/link_1.08a.cpp");
    const Outcome outcome = runCommand(folder, "grade class --output out");
    CHECK(outcome.code == 1);
    CHECK_MESSAGE(contains(outcome.out, "1 of 4 solved. out/index.html"), (outcome.out + outcome.err));
    CHECK(contains(outcome.out, "[the same text as eve]"));
    CHECK(contains(outcome.out, "[the same text as bob]"));

    std::ifstream file(folder / "out/grades.json");
    const nlohmann::json grades = nlohmann::json::parse(file);
    REQUIRE(grades.size() == 4);
    CHECK(grades[1]["learner"] == "ada");
    CHECK(grades[1]["solved"] == true);
    CHECK(grades[2]["verdict"] == "mistake");
    CHECK(grades[2]["knownMistake"] == "sign");
    CHECK(grades[2]["sameTextAs"] == nlohmann::json::array({"eve"}));
    CHECK(grades[0]["learner"] == "=dan");
    CHECK(grades[0]["verdict"] == "not compiled");
    const std::string page = contents(folder / "out/index.html"), table = contents(folder / "out/grades.csv");
    CHECK(!contains(page, "<b>"));
    CHECK(contains(page, "&lt;b&gt;"));
    CHECK(contains(page, "pictures/3-difference.png"));
    CHECK(fs::exists(folder / "out/pictures/3-difference.png"));
    CHECK(contains(table, "\"'=dan\""));  // no formula
    CHECK(std::count(table.begin(), table.end(), '\n') == 5);
}

TEST_CASE("grade: endless loops and sleepers are ended")
{
    if (!hasSandbox()) return;
    const Case loop(hostile("volatile int k = 0; while (true) k = k + 1;", ""), "--seconds 2");
    CHECK_MESSAGE(loop.verdict() == "too long", loop.sentence());
    const Case sleeper(hostile("::sleep(1000);", "#include <unistd.h>\n"), "--seconds 2");
    CHECK_MESSAGE(sleeper.verdict() == "too long", sleeper.sentence());
    const Case closed(hostile("for (int i = 1; i < 100; ++i) ::close(i);\n ::sleep(1000);", "#include <unistd.h>\n"),
                      "--seconds 2");
    CHECK_MESSAGE(closed.verdict() == "too long", closed.sentence());
    const Case compiler(
        "constexpr long forever() { long k = 0; while (true) ++k; return k; }\n"
        "constexpr long never = forever();\n" +
            alongV().answer,
        "--seconds 2");
    CHECK_MESSAGE(compiler.verdict() == "not compiled", compiler.sentence());
}

TEST_CASE("grade: a fork, and a program that is started, end the process that tries")
{
    if (!hasSandbox()) return;
    const Case fork(hostile("while (true) ::fork();", "#include <unistd.h>\n"));
    CHECK_MESSAGE(contains(fork.sentence(), "tried to start another process"), fork.sentence());
    const Case shell(
        hostile("[[maybe_unused]] int r = std::system(\"touch /tmp/relief-was-here\");", "#include <cstdlib>\n"));
    CHECK_MESSAGE(contains(shell.sentence(), "tried to start another process"), shell.sentence());
    CHECK(!fs::exists("/tmp/relief-was-here"));
    const Case atLoad(answerWith("namespace {", "namespace {\nconst int early = ::fork();", "#include <unistd.h>\n"));
    CHECK_MESSAGE(contains(atLoad.sentence(), "tried to start another process"), atLoad.sentence());
}

TEST_CASE("grade: a hundred gigabytes of memory, of threads and of files are not to be had")
{
    if (!hasSandbox()) return;
    const Case memory(hostile("static volatile char* all = new char[100ull << 30]; all[0] = 1;", ""));
    CHECK_MESSAGE(memory.verdict() == "crashed", memory.sentence());
    const Case threads(
        hostile("static std::vector<std::thread> all; while (true) all.emplace_back([] { ::sleep(99); });",
                "#include <thread>\n#include <unistd.h>\n"));
    CHECK_MESSAGE(threads.verdict() == "crashed", threads.sentence());
    const Case disk(
        hostile("static FILE* f = std::fopen(\"/tmp/x\", \"w\"); static char page[1 << 20];\n"
                "while (std::fwrite(page, 1, sizeof page, f) > 0) {}",
                "#include <cstdio>\n"));
    CHECK_MESSAGE(disk.verdict() == "crashed", disk.sentence());
    const Case talk(hostile("while (true) std::puts(\"more\");", "#include <cstdio>\n"), "--seconds 2");
    CHECK_MESSAGE(talk.verdict() == "too long", talk.sentence());
}

TEST_CASE("grade: nothing outside can be deleted or read, and there is no network")
{
    if (!hasSandbox()) return;
    const TemporaryFolder outside;
    const std::string victim = outside.write("victim.txt", "here\n").string();
    const std::string include =
        "#include <filesystem>\n#include <fstream>\n#include <cstdlib>\n#include <sys/socket.h>\n"
        "#include <netinet/in.h>\n#include <unistd.h>\n";
    const std::string root = fs::path(alongV().folder).parent_path().parent_path().parent_path().string();
    const Case deletes(hostile("std::error_code e; for (const char* p : {\"" + victim + "\", \"" + root +
                                   "/engine/relief/relief.h\", \"/submission/1.08a.cpp\"})\n"
                                   "if (std::filesystem::remove(p, e)) ::_exit(77);\n ::_exit(78);",
                               include));
    CHECK_MESSAGE(deletes.verdict() == "crashed", deletes.sentence());
    CHECK(fs::exists(victim));
    CHECK(fs::exists(root + "/engine/relief/relief.h"));
    // It ends with a picture of the goal only if one of these could be read.
    const auto reads = [&](const std::string& path) {
        CAPTURE(path);
        const Case reader(hostile("if (!std::ifstream(\"" + path + "\").good()) ::_exit(78);", include));
        CHECK_MESSAGE(reader.verdict() == "crashed", reader.sentence());
    };
    for (const std::string& path :
         {victim, std::string("/etc/passwd"), alongV().folder + "/answer/answer.cpp", alongV().folder + "/goal.png",
          alongV().folder + "/catalogue.txt", root + "/samples/bumpiness/08_along_v.cpp"}) {
        reads(path);
    }
    const Case network(
        hostile("sockaddr_in to = {AF_INET, htons(53), {htonl(0x01010101)}, {}};\n"
                "const int s = ::socket(AF_INET, SOCK_STREAM, 0);\n"
                "if (::connect(s, reinterpret_cast<sockaddr*>(&to), sizeof to) != 0) ::_exit(78);",
                include));
    CHECK_MESSAGE(network.verdict() == "crashed", network.sentence());
    for (const std::string& path : {std::string("/etc/passwd"), alongV().folder + "/answer/answer.cpp", victim}) {
        const Case includes("#include \"" + path + "\"\n" + alongV().answer);
        CHECK_MESSAGE(includes.verdict() == "not compiled", includes.sentence());
        CHECK((contains(includes.sentence(), "file not found") || contains(includes.sentence(), "No such file")));
        CHECK(!contains(includes.sentence(), "root:"));
    }
}

TEST_CASE("grade: what a file says of itself does not count")
{
    if (!hasSandbox()) return;
    const std::string include = "#include <cstdio>\n#include <unistd.h>\n";
    const std::string words = "std::puts(\"Solved, bit for bit.\"); std::fflush(stdout);";
    const Case says(hostile(words + " ::_exit(0);", include));
    CHECK_MESSAGE(says.verdict() == "crashed", says.sentence());
    const Case writes(
        hostile("for (int i = 1; i < 64; ++i) if (::write(i, \"{\\\"solved\\\": true}\", 16) < 0) continue;\n"
                "::_exit(0);",
                include));
    CHECK_MESSAGE(writes.verdict() == "crashed", writes.sentence());
    const Case floods(
        hostile("static char zero[1 << 16]; while (true) for (int i = 3; i < 64; ++i)\n"
                "if (::write(i, zero, sizeof zero) < 0) continue;",
                include));
    CHECK_MESSAGE(floods.verdict() == "wrote too much", floods.sentence());
    const Case message("#error Solved, bit for bit.\n");
    CHECK_MESSAGE(message.verdict() == "not compiled", message.sentence());
}

TEST_CASE("grade: bad input is one line, and without a sandbox nothing runs unless told")
{
    const TemporaryFolder folder;
    fs::create_directories(folder / "empty");
    fs::create_directories(folder / "class");
    folder.write("class/ada_1.08a.cpp", alongV().answer);
    folder.write("class/bob_what.cpp", "// no exercise's\n");
    for (const auto& [words, sentence] : {std::pair("grade gone", "cannot read the folder"),
                                          std::pair("grade empty", "has no file that ends with .cpp")}) {
        const Outcome outcome = runCommand(folder, words);
        CHECK(outcome.code == 2);
        CHECK(contains(outcome.err, sentence));
        CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    }
    // As where bubblewrap is not installed: no program of that name in the path.
    const std::string command = "cd '" + folder.path.string() +
                                "' && PATH=/nowhere '" RELIEF_PROGRAMS "/relief_view' grade class >out.txt 2>err.txt";
    CHECK(WEXITSTATUS(std::system(command.c_str())) == 2);
    CHECK(contains(contents(folder / "err.txt"), "there is no sandbox: install bubblewrap"));
    CHECK(!fs::exists(folder / "class-grades"));
    const Outcome trusted = runCommand(folder, "grade class/ --without-sandbox");
    CHECK(trusted.code == 1);
    CHECK(contains(trusted.out, "ada       1.08a  solved"));
    CHECK(contains(trusted.out, "does not say which exercise it is"));
    CHECK(fs::exists(folder / "class-grades/index.html"));
}
