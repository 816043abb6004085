// OBJ files: conversion to the left-handed world, welding, polygons, normals, and one clear line for every bad file.
#include "relief/mesh/obj.h"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "contents.h"
#include "temporary_folder.h"

using namespace relief;

namespace {

Mesh read(const std::string& text)
{
    const TemporaryFolder folder;
    const Expected<Mesh> mesh = readObj(folder.write("shape.obj", text));
    REQUIRE_MESSAGE(mesh.has_value(), mesh.error().message);
    return *mesh;
}

// The message without the file's name.
std::string errorOf(const std::string& text)
{
    const TemporaryFolder folder;
    const std::filesystem::path path = folder.write("shape.obj", text);
    const Expected<Mesh> mesh = readObj(path);
    if (mesh) return "";
    const std::string& message = mesh.error().message;
    CHECK(message.find('\n') == std::string::npos);
    CHECK(message.find(path.string() + ": ") == 0);
    return message.substr(path.string().size() + 2);
}

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

}  // namespace

TEST_CASE("obj: a triangle becomes left-handed and keeps its front")
{
    // Counter-clockwise seen from +z, where right-handed x points right.
    const Mesh mesh = read(kTriangle + "vt 0 0\nvt 1 0\nvt 0 0.25\nf 1/1 2/2 3/3\n");
    REQUIRE(mesh.positions.size() == 3);
    CHECK(mesh.name == "shape");
    CHECK(mesh.positions == std::vector<glm::vec3>{{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}});
    CHECK(!std::signbit(mesh.positions[0].x));
    CHECK(mesh.uvs == std::vector<glm::vec2>{{0, 0}, {0, 0.25f}, {1, 0}});
    CHECK(mesh.indices == std::vector<std::uint32_t>{0, 1, 2});
    CHECK(mesh.normals == std::vector<glm::vec3>(3, glm::vec3(0, 0, 1)));
    CHECK(mesh.tangents.empty());
}

TEST_CASE("obj: given normals are mirrored and scaled to unit length")
{
    const Mesh mesh = read(kTriangle + "vn 0 0 1\nvn 3 0 4\nf 1//1 2//2 3//1\n");
    CHECK(mesh.normals == std::vector<glm::vec3>{{0, 0, 1}, {0, 0, 1}, {-0.6f, 0, 0.8f}});
    CHECK(mesh.uvs.empty());
    const Mesh zero = read(kTriangle + "vn 0 0 0\nf 1//1 2//1 3//1\n");
    CHECK(zero.normals == std::vector<glm::vec3>(3, glm::vec3(0, 0, 1)));
}

TEST_CASE("obj: corners are welded in the order of first use")
{
    const std::string quad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    const Mesh mesh = read(quad + "f 1 2 3 4\n");
    CHECK(mesh.positions.size() == 4);
    CHECK(mesh.indices == std::vector<std::uint32_t>{0, 1, 2, 0, 3, 1});

    // The same positions with different uvs stay apart, but their computed normals agree.
    const Mesh folded = read("v 0 0 0\nv 0 1 0\nv 1 0 0\nv 0 0 1\nvt 0 0\nvt 1 1\nf 1/1 3/1 2/1\nf 1/2 2/2 4/2\n");
    REQUIRE(folded.positions.size() == 6);
    int pairs = 0;
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if (folded.positions[i] != folded.positions[j]) continue;
            CHECK(folded.normals[i] == folded.normals[j]);
            ++pairs;
        }
    }
    CHECK(pairs == 2);
}

TEST_CASE("obj: negative numbers count back, and positive ones may name what comes later")
{
    const Mesh expected = read(kTriangle + "v 5 5 5\nf 1 2 3\n");
    CHECK(read(kTriangle + "f -3 -2 -1\nv 5 5 5\n").positions == expected.positions);
    CHECK(read("f 1 2 3\n" + kTriangle).positions == expected.positions);
    const Mesh mixed = read(kTriangle + "vt 0 0\nvn 0 0 1\nf -3/-1/-1 2/1/1 3/-1/1\n");
    CHECK(mixed.positions == expected.positions);
}

TEST_CASE("obj: concave polygons keep their area")
{
    const Mesh mesh = read(
        "v 10 10 0\nv 13 10 0\nv 13 13 0\nv 12 13 0\nv 12 11 0\nv 11 11 0\nv 11 13 0\nv 10 13 0\n"
        "f 1 2 3 4 5 6 7 8\n");
    REQUIRE(mesh.indices.size() == 18);
    float area = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::vec3 a = mesh.positions[mesh.indices[i]];
        area += 0.5f * glm::cross(mesh.positions[mesh.indices[i + 1]] - a, mesh.positions[mesh.indices[i + 2]] - a).z;
    }
    CHECK(area == doctest::Approx(7.0f));
}

TEST_CASE("obj: uvs that only some corners have are 0 elsewhere")
{
    const Mesh mesh = read(kTriangle + "v 1 1 0\nvt 0.5 0.5\nf 1/1 2/1 3/1\nf 2 4 3\n");
    REQUIRE(mesh.uvs.size() == mesh.positions.size());
    CHECK(mesh.uvs.front() == glm::vec2(0.5f));
    CHECK(mesh.uvs.back() == glm::vec2(0));
}

TEST_CASE("obj: line ends, comments, marks and unknown words")
{
    const std::vector<glm::vec3> expected = read(kTriangle + "f 1 2 3\n").positions;
    CHECK(read("v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n").positions == expected);
    CHECK(read("v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3").positions == expected);
    CHECK(read("\xef\xbb\xbfv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3").positions == expected);
    CHECK(read("# v 9 9 9\n  v\t0  0 0 # here\nv 1. +0e5 -0 0.5\nv .0 1 0 1 0 0\n\nf 1 2 3 # v 1\n").positions ==
          expected);
    CHECK(read("mtllib a.mtl\no x\ng y z\ns off\nusemtl m\nl 1 2\np 1\n" + kTriangle + "f 1 2 3\nusemtl n\ng\n")
              .positions == expected);
}

TEST_CASE("obj: of several references to nothing the first is named, whatever comes behind")
{
    CHECK(contains(errorOf("f 1 2 9\nf 1 2 3\nf 1 2 12\n" + kTriangle), "line 1: there is no vertex 9 among 3"));
    CHECK(contains(errorOf("f 1 2 3\nf 1/4 2/1 8/1\n" + kTriangle + "vt 0 0\nf 1/9 2 3\n"),
                   "line 2: there is no vertex 8 among 3"));
    CHECK(contains(errorOf("f 1 2 3\nf 1/4 2 3\nf 1 2 8\n" + kTriangle), "line 2: there is no uv 4 among 0"));
}

TEST_CASE("obj: normals that a face names and the file lacks are made")
{
    const std::vector<glm::vec3> made(3, glm::vec3(0, 0, 1));
    CHECK(read(kTriangle + "f 1//1 2//2 3//3\n").normals == made);
    CHECK(read(kTriangle + "vt 0 0\nf 1/1/1 2/1/1 3/1/1\n").normals == made);
    CHECK(read(kTriangle + "f 1//-1 2//-1 3//-1\n").normals == made);
    const Mesh some = read(kTriangle + "f 1//2 2//1 3//1\nvn 0 1 0\n");
    CHECK(some.normals == std::vector<glm::vec3>{{0, 0, 1}, {0, 1, 0}, {0, 1, 0}});
}

TEST_CASE("obj: vertices with colours")
{
    const Mesh mesh = read(
        "v 0 0 0 0.25 0.5 1\nv 1 0 0 1 0 0\nv 0 1 0\nv 1 1 0 0 0 2\nvt 0 0\nvt 1 1\n"
        "f 1/1 2/1 3/1\nf 2/2 4/2 3/2\n");
    REQUIRE(mesh.positions.size() == 6);
    for (std::size_t i = 0; i < 6; ++i) {
        const glm::vec3 p = mesh.positions[i];
        const glm::vec4 expected = p.x == 0 && p.y == 0 ? glm::vec4(0.25f, 0.5f, 1, 1)
                                   : p.y == 0           ? glm::vec4(1, 0, 0, 1)
                                   : p.x == 0           ? glm::vec4(1)
                                                        : glm::vec4(0, 0, 2, 1);
        CHECK(mesh.colors[i] == expected);
    }
    CHECK(read("v 0 0 0\nv 1 0 0\nv 0 1 0 0 0 0\nf 1 2 3\n").colors ==
          std::vector<glm::vec4>{glm::vec4(1), {0, 0, 0, 1}, glm::vec4(1)});
    CHECK(read(kTriangle + "f 1 2 3\n").colors.empty());
    // A fourth number is a weight, of which nothing is made.
    CHECK(read("v 0 0 0 2\nv 1 0 0 2\nv 0 1 0 2\nf 1 2 3\n").colors.empty());
    CHECK(read("v 0 0 0 2\nv 1 0 0 2\nv 0 1 0 2\nf 1 2 3\n").positions == read(kTriangle + "f 1 2 3\n").positions);
    CHECK(contains(errorOf("v 0 0 0 1 1 x\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "line 1: 'x' is not"));
}

TEST_CASE("obj: bad references name their line")
{
    CHECK(contains(errorOf(kTriangle + "f 1 2 4\n"), "line 4: there is no vertex 4 among 3"));
    CHECK(contains(errorOf(kTriangle + "f 1 2 0\n"), "line 4: there is no vertex 0 among 3"));
    CHECK(contains(errorOf(kTriangle + "f 1 2 -4\n"), "line 4: there is no vertex -4 among 3"));
    CHECK(contains(errorOf("v 0 0 0\nv 1 0 0\nf -1 -2 -3\nv 0 1 0\n"), "line 3: there is no vertex -3 among 2"));
    CHECK(contains(errorOf(kTriangle + "vt 0 0\nf 1/1 2/1 3/2\n"), "line 5: there is no uv 2 among 1"));
    CHECK(contains(errorOf(kTriangle + "vt 0 0\nf 1/1 2/1 3/-2\n"), "line 5: there is no uv -2 among 1"));
    CHECK(contains(errorOf(kTriangle + "vn 0 0 1\nf 1//1 2//1 3//0\n"), "line 5: there is no normal 0 among 1"));
    CHECK(contains(errorOf(kTriangle + "f 1/1/1 2/1/1 3/1/1\n"), "line 4: there is no uv 1 among 0"));
    CHECK(contains(errorOf(kTriangle + "f 1 2 99999999999999\n"), "line 4: '99999999999999' is not a reference"));
    for (const std::string bad :
         {"x", "1/", "1//", "/1", "1/1/", "1/1/1/1", "1.5", "1e0", "nan", "+1", "--1", "1//x"}) {
        CAPTURE(bad);
        CHECK(contains(errorOf(kTriangle + "vt 0 0\nvn 0 0 1\n\nf 1 2 " + bad + "\n"), "line 7: '" + bad + "' is not"));
    }
}

TEST_CASE("obj: bad numbers name their line")
{
    for (const std::string bad :
         {"nan", "inf", "-inf", "1e", "1e+", "0x10", "abc", "1,5", ".", "+", "1.2.3", "1e1234567890123", "1d5"}) {
        CAPTURE(bad);
        CHECK(contains(errorOf("v 0 0 0\nv 1 0 " + bad + "\nv 0 1 0\nf 1 2 3\n"), "line 2: '" + bad + "' is not"));
        CHECK(contains(errorOf(kTriangle + "vt " + bad + " 0\nf 1/1 2/1 3/1\n"), "line 4: '" + bad + "' is not"));
        CHECK(contains(errorOf(kTriangle + "vn 0 0 " + bad + "\nf 1//1 2//1 3//1\n"), "line 4: '" + bad + "' is not"));
    }
    CHECK(contains(errorOf("v 0 0\n" + kTriangle + "f 1 2 3\n"), "line 1: 2 numbers after 'v'"));
    CHECK(contains(errorOf("v\n" + kTriangle + "f 1 2 3\n"), "line 1: 0 numbers after 'v'"));
    CHECK(contains(errorOf("vn 1 0\n" + kTriangle + "f 1 2 3\n"), "line 1: 2 numbers after 'vn'"));
    CHECK(contains(errorOf("v 0 0 0\nv 1e39 0 0\nv 0 1 0\nf 1 2 3\n"), "line 2: '1e39' is not a finite"));
    CHECK(contains(errorOf("v 0 0 0\nv 1e999 0 0\nv 0 1 0\nf 1 2 3\n"), "line 2: '1e999' is not a finite"));
}

TEST_CASE("obj: bad faces and files without any")
{
    CHECK(contains(errorOf(kTriangle + "f 1 2\n"), "line 4: a face with 2 corners"));
    CHECK(contains(errorOf(kTriangle + "f\n"), "line 4: a face with 0 corners"));
    CHECK(contains(errorOf(kTriangle), "has no faces"));
    CHECK(contains(errorOf("f 1 2 3\n"), "line 1: there is no vertex 1 among 0"));
    CHECK(contains(errorOf(kTriangle + "f 1 2 \\\n3\n"), "line 4: continued lines"));
    std::string many = kTriangle + "f";
    for (int i = 0; i < 5000; ++i) many += " 1";
    CHECK(contains(errorOf(many), "line 4: a face with 5000 corners"));
}

TEST_CASE("obj: files that are no OBJ")
{
    const TemporaryFolder folder;
    CHECK(contains(readObj(folder / "missing.obj").error().message, "cannot open (No such file or directory)"));
    CHECK(contains(readObj(folder.path).error().message, "is a directory"));
    CHECK(contains(errorOf(""), "is empty"));
    CHECK(contains(errorOf("hello\nworld\n"), "has no faces"));
    CHECK(contains(errorOf(std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16)), "is not a text file"));
    std::string noise;
    std::uint32_t state = 3;
    for (int i = 0; i < 4096; ++i) {
        state = state * 1664525u + 1013904223u;
        noise += static_cast<char>(1 + (state >> 24) % 255);
    }
    CHECK(errorOf(noise) != "");
}

TEST_CASE("obj: no random damage crashes the reader")
{
    const std::string whole =
        kTriangle + "v 1 1 0\nvt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 4/-1/-1 3/1/1\nf 1 2 3\nf 1//1 -1//1 2//1\n";
    const std::string letters = "vftn0123456789-/. e\n\r\t#\\ol";
    const TemporaryFolder folder;
    std::uint32_t state = 5;
    const auto next = [&](std::size_t limit) {
        state = state * 1664525u + 1013904223u;
        return static_cast<std::size_t>(state >> 8) % limit;
    };
    int read = 0;
    for (int round = 0; round < 2000; ++round) {
        std::string text = whole;
        for (std::size_t damages = 1 + next(3); damages > 0; --damages) {
            text[next(text.size())] = letters[next(letters.size())];
        }
        const Expected<Mesh> mesh = readObj(folder.write("damaged.obj", text));
        if (!mesh) continue;
        ++read;
        CHECK(validate(*mesh).has_value());
    }
    CHECK(read > 0);
    CHECK(read < 2000);
}

TEST_CASE("obj: the bunny")
{
    const std::filesystem::path path = "/usr/share/glmark2/models/bunny.obj";
    if (!std::filesystem::exists(path)) {
        MESSAGE("skipped: " << path.string() << " is not installed (package glmark2-data)");
        return;
    }
    const Expected<Mesh> mesh = readObj(path);
    REQUIRE_MESSAGE(mesh.has_value(), mesh.error().message);
    CHECK(mesh->name == "bunny");
    CHECK(mesh->indices.size() / 3 == 69666);
    std::size_t facing = 0;
    for (std::size_t i = 0; i < mesh->indices.size(); i += 3) {
        const glm::vec3 a = mesh->positions[mesh->indices[i]];
        const glm::vec3 b = mesh->positions[mesh->indices[i + 1]];
        const glm::vec3 c = mesh->positions[mesh->indices[i + 2]];
        facing += glm::dot(glm::cross(b - a, c - a), mesh->normals[mesh->indices[i]]) > 0;
    }
    CHECK(facing > 69000);
}
