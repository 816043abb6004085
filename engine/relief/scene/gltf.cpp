// glTF in four steps: parse (gltf_parse.h), walk through the nodes, and for each primitive and material that is met for
// the first time convert it.
#include "relief/scene/gltf.h"

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "relief/lanes/environment.h"
#include "relief/lanes/trigonometry.h"
#include "relief/mesh/tangents.h"
#include "relief/path.h"
#include "relief/scene/gltf_accessors.h"
#include "relief/scene/gltf_parse.h"
#include "relief/scene/gltf_text.h"
#include "relief/scene/tinygltf.h"
#include "relief/texture/import.h"

namespace relief::inline RELIEF_WIDTH {
namespace {

// "materials[3]"
std::string element(const std::string& array, std::size_t index)
{
    return array + "[" + std::to_string(index) + "]";
}

float floatOf(double number, double low = -FLT_MAX, double high = FLT_MAX)
{
    return static_cast<float>(std::clamp(number, low, high));
}

// What a line of text may hold: names in a file can have line ends in them, and be long.
std::string oneLine(std::string text)
{
    while (!text.empty() && text.back() == '\n') text.pop_back();
    for (char& c : text) {
        if (static_cast<unsigned char>(c) < 32 || c == 127) c = ' ';
    }
    return text.size() <= 400 ? text : text.substr(0, 200) + " ... " + text.substr(text.size() - 190);
}

// --- numbers of extensions, as tinygltf gives them ---

double numberIn(const tinygltf::Value& object, const char* name, double usual)
{
    return object.IsObject() && object.Has(name) && object.Get(name).IsNumber() ? object.Get(name).GetNumberAsDouble()
                                                                                : usual;
}

glm::dvec2 pairIn(const tinygltf::Value& object, const char* name, glm::dvec2 usual)
{
    if (!object.IsObject() || !object.Has(name)) return usual;
    const tinygltf::Value& list = object.Get(name);
    if (!list.IsArray() || list.Size() != 2 || !list.Get(0).IsNumber() || !list.Get(1).IsNumber()) return usual;
    return {list.Get(0).GetNumberAsDouble(), list.Get(1).GetNumberAsDouble()};
}

// --- x negated, and what follows from it ---

// S M S with S = diag(-1, 1, 1, 1).
glm::dmat4 leftHanded(glm::dmat4 m)
{
    for (int i = 1; i < 4; ++i) {
        m[0][i] = -m[0][i];
        m[i][0] = -m[i][0];
    }
    return m;
}

glm::dmat4 rotation(glm::dvec4 q)
{
    const double length = std::sqrt(glm::dot(q, q));
    q = length > 0 ? q / length : glm::dvec4(0, 0, 0, 1);
    const auto [x, y, z, w] = std::array{q.x, q.y, q.z, q.w};
    return {{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y), 0},
            {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x), 0},
            {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y), 0},
            {0, 0, 0, 1}};
}

// parentFromNode, right-handed as in the file. checkGltfText has counted the numbers.
glm::dmat4 matrixOf(const tinygltf::Node& node)
{
    glm::dmat4 m(1.0);
    if (!node.matrix.empty()) {
        for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
        return m;
    }
    if (!node.rotation.empty()) m = rotation({node.rotation[0], node.rotation[1], node.rotation[2], node.rotation[3]});
    for (int i = 0; i < 3 && !node.scale.empty(); ++i) m[i] *= node.scale[static_cast<std::size_t>(i)];
    for (int i = 0; i < 3 && !node.translation.empty(); ++i) m[3][i] = node.translation[static_cast<std::size_t>(i)];
    return m;
}

// A matrix of floats, if they are finite.
bool isUsable(const glm::dmat4& m)
{
    for (int i = 0; i < 16; ++i) {
        if (!(std::abs(m[i / 4][i % 4]) <= 1e30)) return false;
    }
    return true;
}

// --- triangles ---

// How many indices a list has that is made of these.
std::size_t lengthOfList(std::size_t given, int mode)
{
    if (mode == TINYGLTF_MODE_TRIANGLES) return given - given % 3;
    return given < 3 ? 0 : (given - 2) * 3;
}

// Strips and fans as lists, without what is left over (glTF 2.0, 3.7.2.1); reversed, as x is negated.
std::vector<std::uint32_t> triangleList(const std::vector<std::uint32_t>& given, int mode)
{
    std::vector<std::uint32_t> list;
    list.reserve(lengthOfList(given.size(), mode));
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
        for (const std::size_t corner : {a, c, b}) list.push_back(given[corner]);
    };
    const std::size_t count = given.size();
    if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
        for (std::size_t i = 0; i + 2 < count; ++i) add(i, i + 1 + i % 2, i + 2 - i % 2);
    } else if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
        for (std::size_t i = 0; i + 2 < count; ++i) add(i + 1, i + 2, 0);
    } else {
        for (std::size_t i = 0; i + 2 < count; i += 3) add(i, i + 1, i + 2);
    }
    return list;
}

template <class Vector>
std::vector<Vector> vectorsOf(const std::vector<float>& numbers)
{
    constexpr auto kSize = static_cast<std::size_t>(Vector::length());
    std::vector<Vector> vectors(numbers.size() / kSize);
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        for (int c = 0; c < Vector::length(); ++c) vectors[i][c] = numbers[i * kSize + static_cast<std::size_t>(c)];
    }
    return vectors;
}

// The attributes of a primitive, as many each as positions or none.
struct Attributes
{
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec4> tangents, colors;
    std::vector<glm::vec2> uvs[2];
};

template <class Vector>
void gather(std::vector<Vector>& vectors, const std::vector<std::uint32_t>& indices)
{
    if (vectors.empty()) return;
    std::vector<Vector> gathered(indices.size());
    for (std::size_t i = 0; i < indices.size(); ++i) gathered[i] = vectors[indices[i]];
    vectors = std::move(gathered);
}

void gatherAll(Attributes& all, const std::vector<std::uint32_t>& indices)
{
    gather(all.positions, indices);
    gather(all.normals, indices);
    gather(all.tangents, indices);
    gather(all.colors, indices);
    gather(all.uvs[0], indices);
    gather(all.uvs[1], indices);
}

// Every corner a vertex of its own, with the normal of its triangle: what a file without normals asks for.
void makeFlat(Attributes& all, std::vector<std::uint32_t>& indices)
{
    all.tangents.clear();
    gatherAll(all, indices);
    for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = static_cast<std::uint32_t>(i);
    Mesh mesh;
    mesh.positions = all.positions;
    mesh.indices = indices;
    computeNormals(mesh);
    all.normals = std::move(mesh.normals);
}

// Only the vertices that some index names: primitives often share one large list.
void keepUsed(Attributes& all, std::vector<std::uint32_t>& indices)
{
    constexpr std::uint32_t kUnused = 0xffffffffu;
    std::vector<std::uint32_t> newIndex(all.positions.size(), kUnused), used;
    for (const std::uint32_t index : indices) newIndex[index] = 0;
    for (std::uint32_t i = 0; i < newIndex.size(); ++i) {
        if (newIndex[i] == kUnused) continue;
        newIndex[i] = static_cast<std::uint32_t>(used.size());
        used.push_back(i);
    }
    if (used.size() == newIndex.size()) return;
    for (std::uint32_t& index : indices) index = newIndex[index];
    gatherAll(all, used);
}

// Of unit length; smooth where the file has one of length zero.
void repairNormals(Attributes& all, const std::vector<std::uint32_t>& indices)
{
    std::vector<glm::vec3> computed;
    for (std::size_t i = 0; i < all.normals.size(); ++i) {
        glm::vec3& normal = all.normals[i];
        normal = normalizedOrZero(normal);
        if (normal != glm::vec3(0)) continue;
        if (computed.empty()) {
            Mesh mesh;
            mesh.positions = all.positions;
            mesh.indices = indices;
            computeNormals(mesh);
            computed = std::move(mesh.normals);
        }
        normal = computed[i];
    }
}

// Exchanges the two sets of uvs.
void exchangeUvs(Mesh& mesh)
{
    std::vector<float> first;
    for (const glm::vec2& uv : mesh.uvs) first.insert(first.end(), {uv.x, uv.y});
    mesh.uvs = vectorsOf<glm::vec2>(mesh.streams[0].floats);
    mesh.streams[0].floats = std::move(first);
}

// The mesh that SceneFile promises.
Expected<Mesh> complete(Attributes all, std::vector<std::uint32_t> indices, const SceneMaterial& material)
{
    const std::size_t count = all.positions.size();
    for (std::vector<glm::vec2>& uvs : all.uvs) uvs.resize(count, glm::vec2(0.0f));
    all.colors.resize(count, glm::vec4(1.0f));
    Mesh mesh;
    mesh.positions = std::move(all.positions);
    mesh.normals = std::move(all.normals);
    mesh.uvs = std::move(all.uvs[0]);
    mesh.colors = std::move(all.colors);
    mesh.indices = std::move(indices);
    mesh.streams.push_back({.semantic = "TEXCOORD", .index = 1, .components = 2, .floats = {}, .integers = {}});
    std::vector<float>& second = mesh.streams[0].floats;
    for (const glm::vec2& uv : all.uvs[1]) second.insert(second.end(), {uv.x, uv.y});
    if (!material.hasNormalMap()) return mesh;
    if (!all.tangents.empty()) {
        mesh.tangents = std::move(all.tangents);
        return mesh;
    }
    const bool ofSecond = material.normalTexture.uvSet == 1;
    if (ofSecond) exchangeUvs(mesh);
    Expected<Mesh> made = withTangents(std::move(mesh));
    if (made && ofSecond) exchangeUvs(*made);
    return made;
}

tl::unexpected<Error> failTooLarge(const std::string& field)
{
    return fail(field + ": the scene has more than " + std::to_string(kMaxSceneVertices) + " vertices or " +
                std::to_string(kMaxSceneIndices) + " indices, or reads more than " + std::to_string(kMaxReadVertices) +
                " vertices; simplify it");
}

// --- the file ---

class Reader
{
public:
    Reader(const std::string& itsPath, const tinygltf::Model& model) : path(itsPath), file(model), accessors(model) {}

    Expected<SceneFile> read()
    {
        const Expected<void> done = checkNodes().and_then([this] { return walk(); });
        if (!done) return tl::unexpected(done.error());
        if (scene.instances.empty()) {
            return fail(leavesLinesOut
                            ? "has points and lines, but no triangles to draw; export the file with triangles"
                            : "has no triangles to draw; export the file again");
        }
        noteWhatIsLeftOut();
        return std::move(scene);
    }

private:
    Expected<void> checkNodes() const;
    Expected<void> walk();
    Expected<std::vector<int>> roots() const;
    Expected<void> addMesh(const tinygltf::Node& node, const std::string& field, const glm::mat4& worldFromObject);
    Expected<void> addCamera(const tinygltf::Node& node, const std::string& field, const glm::dmat4& worldFromNode);
    Expected<void> addLight(const tinygltf::Node& node, const std::string& field, const glm::dmat4& worldFromNode);
    Expected<std::optional<std::size_t>> meshOf(std::size_t mesh, std::size_t primitive);
    Expected<Attributes> attributesOf(const tinygltf::Primitive& primitive, const std::string& field);
    Expected<std::vector<std::uint32_t>> indicesOf(const tinygltf::Primitive& primitive, const std::string& field,
                                                   std::size_t vertices) const;
    Expected<std::size_t> materialOf(int index, const std::string& user);
    Expected<MaterialTexture> textureOf(int index, int uvSet, const tinygltf::ExtensionMap& extensions,
                                        ColorSpace meaning, const std::string& user);
    Expected<std::shared_ptr<const Texture>> imageOf(int index, ColorSpace meaning, const std::string& user);
    Expected<ImageFile> pictureOf(const tinygltf::Image& image, const std::string& field) const;
    void noteWhatIsLeftOut();

    const std::string& path;
    const tinygltf::Model& file;
    GltfAccessors accessors;
    SceneFile scene;
    std::map<std::pair<std::size_t, std::size_t>, std::optional<std::size_t>> meshes;  // no number: nothing to draw
    std::map<int, std::size_t> materials;
    std::map<std::pair<int, ColorSpace>, std::shared_ptr<const Texture>> textures;
    std::vector<std::size_t> materialOfMesh;  // of each of the scene's
    std::vector<Bounds> boundsOfMesh;         // of each of the scene's, in object space
    std::size_t verticesRead = 0, verticesKept = 0, indices = 0, drawnIndices = 0, texels = 0;
    bool leavesLinesOut = false, leavesMorphsOut = false;
};

// Every child is there, and has one parent: then there is no cycle among what the roots lead to.
Expected<void> Reader::checkNodes() const
{
    std::vector<bool> hasParent(file.nodes.size(), false);
    for (std::size_t i = 0; i < file.nodes.size(); ++i) {
        for (const int child : file.nodes[i].children) {
            const std::string field = element("nodes", i) + ".children";
            if (child < 0 || static_cast<std::size_t>(child) >= file.nodes.size()) {
                return failMissing(field, "node", child, file.nodes.size());
            }
            if (hasParent[static_cast<std::size_t>(child)]) {
                return fail(field + ": node " + std::to_string(child) + " has two parents; export the file again");
            }
            hasParent[static_cast<std::size_t>(child)] = true;
        }
    }
    return {};
}

// The nodes that the walk begins at; each is there, and the child of none.
Expected<std::vector<int>> Reader::roots() const
{
    std::vector<bool> isChild(file.nodes.size(), false);
    for (const tinygltf::Node& node : file.nodes) {
        for (const int child : node.children) isChild[static_cast<std::size_t>(child)] = true;
    }
    std::vector<int> all;
    if (file.scenes.empty()) {
        for (std::size_t i = 0; i < file.nodes.size(); ++i) {
            if (!isChild[i]) all.push_back(static_cast<int>(i));
        }
        return all;
    }
    const std::size_t chosen = file.defaultScene < 0 ? 0 : static_cast<std::size_t>(file.defaultScene);
    if (chosen >= file.scenes.size()) {
        return failMissing("scene", "scene", file.defaultScene, file.scenes.size());
    }
    std::vector<bool> isRoot(file.nodes.size(), false);
    for (const int root : file.scenes[chosen].nodes) {
        const std::string field = element("scenes", chosen) + ".nodes";
        if (root < 0 || static_cast<std::size_t>(root) >= file.nodes.size()) {
            return failMissing(field, "node", root, file.nodes.size());
        }
        if (isChild[static_cast<std::size_t>(root)]) {
            return fail(field + ": node " + std::to_string(root) +
                        " is a child of another node, or of itself; export the file again");
        }
        if (isRoot[static_cast<std::size_t>(root)]) {
            return fail(field + ": node " + std::to_string(root) + " stands there twice; export the file again");
        }
        isRoot[static_cast<std::size_t>(root)] = true;
        all.push_back(root);
    }
    return all;
}

Expected<void> Reader::walk()
{
    const Expected<std::vector<int>> first = roots();
    if (!first) return tl::unexpected(first.error());
    struct Step
    {
        int node;
        glm::dmat4 worldFromParent;
    };
    std::vector<Step> open;
    for (auto root = first->rbegin(); root != first->rend(); ++root) open.push_back({*root, glm::dmat4(1.0)});
    while (!open.empty()) {
        const Step step = open.back();
        open.pop_back();
        const tinygltf::Node& node = file.nodes[static_cast<std::size_t>(step.node)];
        const std::string field = element("nodes", static_cast<std::size_t>(step.node));
        const glm::dmat4 worldFromNode = step.worldFromParent * matrixOf(node);
        if (!isUsable(worldFromNode)) {
            return fail(field + ": its matrix, with its parents', is not of finite numbers; repair the file");
        }
        const glm::dmat4 world = leftHanded(worldFromNode);
        if (node.skin >= 0 && static_cast<std::size_t>(node.skin) >= file.skins.size()) {
            return failMissing(field + ".skin", "skin", node.skin, file.skins.size());
        }
        if (const Expected<void> added = addCamera(node, field, world); !added) return added;
        if (const Expected<void> added = addLight(node, field, world); !added) return added;
        if (const Expected<void> added = addMesh(node, field, glm::mat4(world)); !added) return added;
        for (auto child = node.children.rbegin(); child != node.children.rend(); ++child) {
            open.push_back({*child, worldFromNode});
        }
    }
    return {};
}

Expected<void> Reader::addMesh(const tinygltf::Node& node, const std::string& field, const glm::mat4& worldFromObject)
{
    if (node.mesh < 0) return {};
    const auto mesh = static_cast<std::size_t>(node.mesh);
    if (mesh >= file.meshes.size()) {
        return failMissing(field + ".mesh", "mesh", node.mesh, file.meshes.size());
    }
    const bool mirrored = glm::determinant(glm::dmat3(worldFromObject)) < 0.0;
    for (std::size_t primitive = 0; primitive < file.meshes[mesh].primitives.size(); ++primitive) {
        const Expected<std::optional<std::size_t>> made = meshOf(mesh, primitive);
        if (!made) return tl::unexpected(made.error());
        if (!*made) continue;
        drawnIndices += scene.meshes[**made].indices.size();
        if (scene.instances.size() >= kMaxSceneInstances || drawnIndices > kMaxDrawnIndices) {
            return fail(field + ".mesh: the scene has more than " + std::to_string(kMaxSceneInstances) +
                        " primitives or " + std::to_string(kMaxDrawnIndices / 3) + " triangles; simplify it");
        }
        const Bounds its = transformed(boundsOfMesh[**made], worldFromObject);
        for (int i = 0; i < 3; ++i) {
            if (!std::isfinite(its.low[i]) || !std::isfinite(its.high[i])) {
                return fail(field + ": its mesh is moved out of the range of floats; repair or rescale the file");
            }
            const bool first = scene.instances.empty();
            scene.bounds.low[i] = first ? its.low[i] : std::min(scene.bounds.low[i], its.low[i]);
            scene.bounds.high[i] = first ? its.high[i] : std::max(scene.bounds.high[i], its.high[i]);
        }
        scene.instances.push_back({**made, materialOfMesh[**made], worldFromObject, mirrored, its});
    }
    return {};
}

// The first one is the scene's. A camera looks along -z of its node; worldFromNode is left-handed.
Expected<void> Reader::addCamera(const tinygltf::Node& node, const std::string& field, const glm::dmat4& worldFromNode)
{
    if (node.camera < 0) return {};
    const auto index = static_cast<std::size_t>(node.camera);
    if (index >= file.cameras.size()) {
        return failMissing(field + ".camera", "camera", node.camera, file.cameras.size());
    }
    if (scene.camera || file.cameras[index].type != "perspective") return {};
    const tinygltf::PerspectiveCamera& its = file.cameras[index].perspective;
    const std::string camera = element("cameras", index) + ".perspective";
    const double degrees = its.yfov * 180.0 / std::numbers::pi;
    if (!(degrees >= 0.1 && degrees <= 179.0)) return fail(camera + ".yfov: is not 0.0018 to 3.12 radians; correct it");
    if (!(its.znear > 1e-30 && its.znear < 1e30)) return fail(camera + ".znear: is not 1e-30 to 1e30; correct it");
    if (its.zfar != 0.0 && !(its.zfar > its.znear)) {  // 0: there is none
        return fail(camera + ".zfar: is not more than znear; correct it");
    }
    const glm::dvec3 forward = -glm::dvec3(worldFromNode[2]), up = glm::dvec3(worldFromNode[1]);
    if (!(glm::dot(forward, forward) > 0.0 && glm::dot(up, up) > 0.0)) {
        return fail(field + ": its matrix leaves its camera no direction; repair the file");
    }
    const float near = floatOf(its.znear);
    scene.camera = {.position = glm::vec3(worldFromNode[3]),
                    .forward = glm::vec3(glm::normalize(forward)),
                    .up = glm::vec3(glm::normalize(up)),
                    .fieldOfView = floatOf(degrees),
                    .nearPlane = near,
                    .farPlane = floatOf(its.zfar) > near ? floatOf(its.zfar) : HUGE_VALF};
    return {};
}

// --- lights ---

// Where to look for a light, and which of the file's it is, if any.
constexpr const char* kLights = "KHR_lights_punctual";

// A number of a light: `usual` where there is none, and an error where it is no number or not within its bounds.
Expected<double> lightNumber(const tinygltf::Value& object, const char* name, const std::string& field, double usual,
                             double low, double high, const char* bounds)
{
    if (!object.Has(name)) return usual;
    const tinygltf::Value& value = object.Get(name);
    const double number = value.IsNumber() ? value.GetNumberAsDouble() : std::nan("");
    if (number >= low && number <= high) return number;
    return fail(field + "." + name + ": is not " + bounds + "; correct it");
}

// Its numbers, without its place.
Expected<SceneLight> lightOf(const tinygltf::Value& its, const std::string& field)
{
    if (!its.IsObject()) return fail(field + ": is no light; export the file again");
    SceneLight made = {};
    const std::string type = its.Has("type") && its.Get("type").IsString() ? its.Get("type").Get<std::string>() : "";
    if (type == "point") {
        made.kind = SceneLight::Kind::point;
    } else if (type == "spot") {
        made.kind = SceneLight::Kind::spot;
    } else if (type != "directional") {
        return fail(field + ".type: is not directional, point or spot; correct it");
    }
    made.color = glm::vec3(1.0f);
    if (its.Has("color")) {
        const tinygltf::Value& color = its.Get("color");
        for (int i = 0; i < 3; ++i) {
            const bool isNumber = color.IsArray() && color.Size() == 3 && color.Get(i).IsNumber();
            const double part = isNumber ? color.Get(i).GetNumberAsDouble() : -1.0;
            if (!(part >= 0.0 && part <= 1.0))
                return fail(field + ".color: is not three numbers of 0 to 1; correct it");
            made.color[i] = floatOf(part);
        }
    }
    const auto number = [](const tinygltf::Value& object, const std::string& of, const char* name, double usual,
                           double low, double high, const char* bounds, float& to) {
        return lightNumber(object, name, of, usual, low, high, bounds).map([&to](double n) {
            to = static_cast<float>(n);
        });
    };
    const Expected<void> read =
        number(its, field, "intensity", 1.0, 0.0, FLT_MAX, "a number of at least 0", made.intensity).and_then([&] {
            return number(its, field, "range", HUGE_VAL, FLT_MIN, FLT_MAX, "a number above 0", made.range);
        });
    if (!read) return tl::unexpected(read.error());
    if (made.kind != SceneLight::Kind::spot) return made;
    const std::string ofSpot = field + ".spot";
    // tinygltf has refused a spot without this object, and leaves out one that is empty.
    const tinygltf::Value& spot = its.Get("spot");
    if (its.Has("spot") && !spot.IsObject()) return fail(ofSpot + ": is no object; export the file again");
    constexpr double kQuarter = std::numbers::pi / 2;
    float inner = 0.0f, outer = 0.0f;
    const Expected<void> angles =
        number(spot, ofSpot, "innerConeAngle", 0.0, 0.0, kQuarter, "an angle of 0 to pi / 2", inner).and_then([&] {
            return number(spot, ofSpot, "outerConeAngle", kQuarter / 2, 0.0, kQuarter + 1e-6, "an angle of 0 to pi / 2",
                          outer);
        });
    if (!angles) return tl::unexpected(angles.error());
    if (!(inner < outer)) return fail(ofSpot + ".innerConeAngle: is not less than outerConeAngle; correct it");
    made.cosInner = cos(Float(inner))[0];  // the engine's own, the same on every machine
    made.cosOuter = std::max(cos(Float(outer))[0], 0.0f);
    return made;
}

// A light shines along -z of its node, as a camera looks; worldFromNode is left-handed.
Expected<void> Reader::addLight(const tinygltf::Node& node, const std::string& field, const glm::dmat4& worldFromNode)
{
    const auto its = node.extensions.find(kLights);
    if (its == node.extensions.end()) return {};
    const std::string user = field + ".extensions." + kLights + ".light";
    const auto list = file.extensions.find(kLights);
    const bool hasList = list != file.extensions.end() && list->second.IsObject() && list->second.Has("lights") &&
                         list->second.Get("lights").IsArray();
    const std::size_t count = hasList ? list->second.Get("lights").Size() : 0;
    const double index = numberIn(its->second, "light", -1.0);
    if (!(index >= 0.0 && index < static_cast<double>(count)) || index != std::floor(index)) {
        return failMissing(user, "light", static_cast<int>(std::clamp(index, -1.0, 1e9)), count);
    }
    const auto number = static_cast<std::size_t>(index);
    const std::string light = std::string("extensions.") + kLights + "." + element("lights", number);
    Expected<SceneLight> made = lightOf(list->second.Get("lights").Get(static_cast<int>(number)), light);
    if (!made) return tl::unexpected(made.error());
    if (scene.lights.size() >= kMaxSceneLights) {
        return fail(user + ": the scene has more than " + std::to_string(kMaxSceneLights) + " lights; simplify it");
    }
    const glm::dvec3 forward = -glm::dvec3(worldFromNode[2]);
    const bool directed = glm::dot(forward, forward) > 0.0;
    if (!directed && made->kind != SceneLight::Kind::point) {
        return fail(field + ": its matrix leaves its light no direction; repair the file");
    }
    made->position = glm::vec3(worldFromNode[3]);
    made->forward = directed ? glm::vec3(glm::normalize(forward)) : glm::vec3(0, 0, 1);
    scene.lights.push_back(*made);
    return {};
}

// --- primitives ---

Expected<std::optional<std::size_t>> Reader::meshOf(std::size_t meshIndex, std::size_t primitiveIndex)
{
    const std::pair key(meshIndex, primitiveIndex);
    if (const auto known = meshes.find(key); known != meshes.end()) return known->second;
    const tinygltf::Mesh& its = file.meshes[meshIndex];
    const tinygltf::Primitive& primitive = its.primitives[primitiveIndex];
    const std::string field = element(element("meshes", meshIndex) + ".primitives", primitiveIndex);
    leavesMorphsOut = leavesMorphsOut || !primitive.targets.empty();
    const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
    if (mode > TINYGLTF_MODE_TRIANGLE_FAN) {
        return fail(field + ".mode: there is no mode " + std::to_string(mode) + "; export the file again");
    }
    if (mode < TINYGLTF_MODE_TRIANGLES || !primitive.attributes.contains("POSITION")) {
        leavesLinesOut = leavesLinesOut || mode < TINYGLTF_MODE_TRIANGLES;
        return meshes[key] = std::nullopt;
    }

    const Expected<std::size_t> material = materialOf(primitive.material, field + ".material");
    if (!material) return tl::unexpected(material.error());
    Expected<Attributes> all = attributesOf(primitive, field);
    if (!all) return tl::unexpected(all.error());
    Expected<std::vector<std::uint32_t>> given = indicesOf(primitive, field, all->positions.size());
    if (!given) return tl::unexpected(given.error());
    // Flat triangles have three vertices each.
    const bool isFlat = all->normals.empty();
    const std::size_t length = lengthOfList(given->size(), mode);
    if (indices + length > kMaxSceneIndices || (isFlat && verticesKept + length > kMaxSceneVertices)) {
        return failTooLarge(field);
    }
    std::vector<std::uint32_t> list = triangleList(*given, mode);
    if (list.empty()) return meshes[key] = std::nullopt;
    if (isFlat) {
        makeFlat(*all, list);
    } else {
        keepUsed(*all, list);
    }
    repairNormals(*all, list);
    verticesKept += all->positions.size();
    indices += length;
    if (verticesKept > kMaxSceneVertices) return failTooLarge(field);

    Expected<Mesh> mesh = complete(std::move(*all), std::move(list), scene.materials[*material]);
    if (!mesh) return fail(field + ": " + mesh.error().message);
    mesh->name = oneLine(its.name.empty() ? field : its.name);
    if (const Expected<void> valid = validate(*mesh); !valid) return fail(field + ": " + valid.error().message);
    materialOfMesh.push_back(*material);
    boundsOfMesh.push_back(boundsOf(*mesh));
    meshes[key] = scene.meshes.size();
    scene.meshes.push_back(std::move(*mesh));
    return meshes[key];
}

Expected<std::vector<std::uint32_t>> Reader::indicesOf(const tinygltf::Primitive& primitive, const std::string& field,
                                                       std::size_t vertices) const
{
    const std::string user = field + ".indices";
    if (primitive.indices >= 0) {
        const Expected<std::size_t> count = accessors.count(primitive.indices, user);
        if (!count) return tl::unexpected(count.error());
        if (*count > kMaxSceneIndices) return failTooLarge(user);
        return accessors.indices(primitive.indices, vertices, user);
    }
    std::vector<std::uint32_t> all(vertices);
    std::iota(all.begin(), all.end(), 0u);
    return all;
}

Expected<Attributes> Reader::attributesOf(const tinygltf::Primitive& primitive, const std::string& field)
{
    std::size_t count = 0;
    // The attribute's numbers; none where the primitive does not have it.
    const auto read = [&](const char* name, int components) -> Expected<std::vector<float>> {
        const auto found = primitive.attributes.find(name);
        if (found == primitive.attributes.end()) return std::vector<float>();
        const std::string user = field + ".attributes." + name;
        const Expected<std::size_t> its = accessors.count(found->second, user);
        if (!its) return tl::unexpected(its.error());
        if (count == 0) verticesRead += *its;
        if (*its > kMaxSceneVertices || verticesRead > kMaxReadVertices) return failTooLarge(user);
        if (count != 0 && *its != count) {
            return fail(user + ": has " + std::to_string(*its) + " elements for " + std::to_string(count) +
                        " positions; export the file again");
        }
        return accessors.floats(found->second, components, user);
    };
    Attributes all;
    Expected<std::vector<float>> numbers = read("POSITION", 3);
    if (!numbers) return tl::unexpected(numbers.error());
    all.positions = vectorsOf<glm::vec3>(*numbers);
    count = all.positions.size();
    if (count == 0) return all;

    if (numbers = read("NORMAL", 3); !numbers) return tl::unexpected(numbers.error());
    all.normals = vectorsOf<glm::vec3>(*numbers);
    if (numbers = read("TANGENT", 4); !numbers) return tl::unexpected(numbers.error());
    all.tangents = vectorsOf<glm::vec4>(*numbers);
    for (const int set : {0, 1}) {
        numbers = read(set == 0 ? "TEXCOORD_0" : "TEXCOORD_1", 2);
        if (!numbers) return tl::unexpected(numbers.error());
        all.uvs[set] = vectorsOf<glm::vec2>(*numbers);
    }
    const auto color = primitive.attributes.find("COLOR_0");
    const bool hasAlpha = color != primitive.attributes.end() && color->second >= 0 &&
                          static_cast<std::size_t>(color->second) < file.accessors.size() &&
                          file.accessors[static_cast<std::size_t>(color->second)].type == TINYGLTF_TYPE_VEC4;
    if (numbers = read("COLOR_0", hasAlpha ? 4 : 3); !numbers) return tl::unexpected(numbers.error());
    if (hasAlpha) {
        all.colors = vectorsOf<glm::vec4>(*numbers);
    } else {
        for (const glm::vec3& rgb : vectorsOf<glm::vec3>(*numbers)) all.colors.emplace_back(rgb, 1.0f);
    }

    // Our conventions; 0 - x, so that 0 stays +0.
    for (glm::vec3& p : all.positions) p.x = 0.0f - p.x;
    for (glm::vec3& n : all.normals) n.x = 0.0f - n.x;
    for (glm::vec4& t : all.tangents) {
        t = glm::vec4(normalizedOrZero({0.0f - t.x, t.y, t.z}), t.w < 0.0f ? 1.0f : -1.0f);
    }
    for (std::vector<glm::vec2>& uvs : all.uvs) {
        for (glm::vec2& uv : uvs) uv.y = 1.0f - uv.y;
    }
    return all;
}

// --- materials ---

// Without textures.
SceneMaterial factorsOf(const tinygltf::Material& its)
{
    const tinygltf::PbrMetallicRoughness& pbr = its.pbrMetallicRoughness;
    SceneMaterial made;
    for (int i = 0; i < 4 && pbr.baseColorFactor.size() == 4; ++i) {
        made.baseColor[i] = floatOf(pbr.baseColorFactor[static_cast<std::size_t>(i)], 0.0, 1.0);
    }
    double strength = 1.0;
    if (const auto found = its.extensions.find("KHR_materials_emissive_strength"); found != its.extensions.end()) {
        strength = numberIn(found->second, "emissiveStrength", 1.0);
    }
    for (int i = 0; i < 3 && its.emissiveFactor.size() == 3; ++i) {
        made.emissive[i] = floatOf(its.emissiveFactor[static_cast<std::size_t>(i)] * strength, 0.0, 1e6);
    }
    made.metallic = floatOf(pbr.metallicFactor, 0.0, 1.0);
    made.roughness = floatOf(pbr.roughnessFactor, 0.0, 1.0);
    made.normalScale = floatOf(its.normalTexture.scale, -1e6, 1e6);
    made.occlusionStrength = floatOf(its.occlusionTexture.strength, 0.0, 1.0);
    made.alphaCutoff = floatOf(its.alphaCutoff, 0.0, 1e6);
    made.twoSided = its.doubleSided;
    made.unlit = its.extensions.contains("KHR_materials_unlit");
    if (its.alphaMode == "MASK") made.alpha = SceneMaterial::Alpha::mask;
    if (its.alphaMode == "BLEND") made.alpha = SceneMaterial::Alpha::blend;
    return made;
}

// Of no material (-1) the default one.
Expected<std::size_t> Reader::materialOf(int index, const std::string& user)
{
    if (const auto known = materials.find(index); known != materials.end()) return known->second;
    if (index >= 0 && static_cast<std::size_t>(index) >= file.materials.size()) {
        return failMissing(user, "material", index, file.materials.size());
    }
    SceneMaterial made;
    if (index >= 0) {
        const tinygltf::Material& its = file.materials[static_cast<std::size_t>(index)];
        const tinygltf::PbrMetallicRoughness& pbr = its.pbrMetallicRoughness;
        made = factorsOf(its);
        const auto take = [&](MaterialTexture& texture, const auto& info, ColorSpace meaning, const char* name) {
            const std::string field = element("materials", static_cast<std::size_t>(index)) + "." + name;
            Expected<MaterialTexture> read = textureOf(info.index, info.texCoord, info.extensions, meaning, field);
            if (read) texture = *read;
            return read.map([](const MaterialTexture&) {});
        };
        using enum ColorSpace;
        const Expected<void> taken =
            take(made.baseColorTexture, pbr.baseColorTexture, srgb, "pbrMetallicRoughness.baseColorTexture")
                .and_then([&] {
                    return take(made.metallicRoughnessTexture, pbr.metallicRoughnessTexture, linear,
                                "pbrMetallicRoughness.metallicRoughnessTexture");
                })
                .and_then([&] { return take(made.normalTexture, its.normalTexture, linear, "normalTexture"); })
                .and_then([&] { return take(made.occlusionTexture, its.occlusionTexture, linear, "occlusionTexture"); })
                .and_then([&] { return take(made.emissiveTexture, its.emissiveTexture, srgb, "emissiveTexture"); });
        if (!taken) return tl::unexpected(taken.error());
    }
    materials[index] = scene.materials.size();
    scene.materials.push_back(made);
    return materials[index];
}

AddressMode addressOf(int wrap)
{
    return wrap == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE     ? AddressMode::clamp
           : wrap == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? AddressMode::mirror
                                                           : AddressMode::wrap;
}

void setFilter(sampler2D& sampler, int minification, int magnification)
{
    if (minification == TINYGLTF_TEXTURE_FILTER_NEAREST || minification == TINYGLTF_TEXTURE_FILTER_LINEAR) {
        sampler.mipmaps = false;
    }
    if (magnification == TINYGLTF_TEXTURE_FILTER_NEAREST) {
        sampler.filter = Filter::nearest;
    } else if (minification == TINYGLTF_TEXTURE_FILTER_LINEAR ||
               minification == TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST) {
        sampler.filter = Filter::bilinear;
    } else if (minification == TINYGLTF_TEXTURE_FILTER_NEAREST ||
               minification == TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST) {
        sampler.filter = magnification == TINYGLTF_TEXTURE_FILTER_LINEAR ? Filter::bilinear : Filter::nearest;
    }
}

// KHR_texture_transform maps glTF's uv by T R S. With v = 1 - v' on both sides it maps ours.
void setTransform(MaterialTexture& texture, const tinygltf::Value& extension)
{
    const glm::dvec2 offset = pairIn(extension, "offset", {0, 0}), scale = pairIn(extension, "scale", {1, 1});
    const Float angle = floatOf(numberIn(extension, "rotation", 0.0));
    const double c = cos(angle)[0], s = sin(angle)[0];  // the engine's own, the same on every machine
    // u' = c sx u + s sy v + ox, v' = -s sx u + c sy v + oy, in glTF's uv.
    const glm::dvec3 u(c * scale.x, s * scale.y, offset.x), v(-s * scale.x, c * scale.y, offset.y);
    const auto flipped = [](const glm::dvec3& row) { return glm::dvec3(row.x, -row.y, row.z + row.y); };
    const glm::dvec3 ourU = flipped(u), ourV = glm::dvec3(0, 0, 1) - flipped(v);
    for (int i = 0; i < 3; ++i) {
        texture.u[i] = floatOf(ourU[i], -1e6, 1e6);
        texture.v[i] = floatOf(ourV[i], -1e6, 1e6);
    }
}

Expected<MaterialTexture> Reader::textureOf(int index, int uvSet, const tinygltf::ExtensionMap& extensions,
                                            ColorSpace meaning, const std::string& user)
{
    MaterialTexture made;
    if (index < 0) return made;
    if (static_cast<std::size_t>(index) >= file.textures.size()) {
        return failMissing(user + ".index", "texture", index, file.textures.size());
    }
    const tinygltf::Texture& its = file.textures[static_cast<std::size_t>(index)];
    const std::string field = element("textures", static_cast<std::size_t>(index));
    made.uvSet = uvSet;
    if (const auto found = extensions.find("KHR_texture_transform"); found != extensions.end()) {
        setTransform(made, found->second);
        made.uvSet = static_cast<int>(std::clamp(numberIn(found->second, "texCoord", uvSet), 0.0, 9.0));
    }
    if (made.uvSet > 1) {
        return fail(user + ".texCoord: TEXCOORD_" + std::to_string(made.uvSet) +
                    " is not read; use TEXCOORD_0 or TEXCOORD_1");
    }
    if (its.sampler >= 0) {
        if (static_cast<std::size_t>(its.sampler) >= file.samplers.size()) {
            return failMissing(field + ".sampler", "sampler", its.sampler, file.samplers.size());
        }
        const tinygltf::Sampler& sampler = file.samplers[static_cast<std::size_t>(its.sampler)];
        made.sampler.u = addressOf(sampler.wrapS);
        made.sampler.v = addressOf(sampler.wrapT);
        setFilter(made.sampler, sampler.minFilter, sampler.magFilter);
    }
    if (its.source < 0) return fail(field + ".source: is missing; export the file with PNG or JPEG pictures");
    const Expected<std::shared_ptr<const Texture>> texture = imageOf(its.source, meaning, field + ".source");
    if (!texture) return tl::unexpected(texture.error());
    made.sampler.texture = texture->get();
    return made;
}

Expected<std::shared_ptr<const Texture>> Reader::imageOf(int index, ColorSpace meaning, const std::string& user)
{
    const std::pair key(index, meaning);
    if (const auto known = textures.find(key); known != textures.end()) return known->second;
    if (static_cast<std::size_t>(index) >= file.images.size()) {
        return failMissing(user, "image", index, file.images.size());
    }
    const std::string field = element("images", static_cast<std::size_t>(index));
    Expected<ImageFile> picture = pictureOf(file.images[static_cast<std::size_t>(index)], field);
    if (!picture) return tl::unexpected(picture.error());
    texels += std::visit([](const auto& p) { return p.pixels.size() / 4; }, *picture);
    if (texels > kMaxSceneTexels) return fail(field + ": the pictures have more than 2^28 pixels; scale them down");
    Expected<Texture> texture = importTexture(std::move(*picture), {.colorSpace = meaning});
    if (!texture) return fail(field + ": " + texture.error().message);
    textures[key] = std::make_shared<const Texture>(std::move(*texture));
    scene.textures.push_back(textures[key]);
    return textures[key];
}

Expected<ImageFile> Reader::pictureOf(const tinygltf::Image& image, const std::string& field) const
{
    if (image.bufferView >= 0) {
        const auto bytes = accessors.view(image.bufferView, field + ".bufferView");
        if (!bytes) return tl::unexpected(bytes.error());
        return decodeImage({bytes->begin(), bytes->end()}, field);
    }
    if (!image.image.empty()) return decodeImage(image.image, field);
    if (image.uri.starts_with("data:")) {
        return fail(field + ".uri: is a data URI, but not image/png or image/jpeg in base64; convert the picture");
    }
    Expected<ImageFile> picture = readImage(pathBeside(path, image.uri));
    if (!picture) return fail(field + ".uri: " + picture.error().message);
    return picture;
}

void Reader::noteWhatIsLeftOut()
{
    const auto note = [this](const std::string& what) { scene.notes.push_back(oneLine(what)); };
    for (const std::string& extension : file.extensionsUsed) {
        if (!isUnderstood(extension)) note("the extension " + extension + " is left out");
    }
    if (leavesLinesOut) note("points and lines are left out");
    if (leavesMorphsOut) note("morph targets are left out: meshes have their basic shape");
    if (!file.skins.empty()) note("skins are left out: meshes stand as they were bound");
    if (!file.animations.empty()) note("animations are left out");
    const bool hasOther = std::any_of(file.cameras.begin(), file.cameras.end(),
                                      [](const tinygltf::Camera& c) { return c.type != "perspective"; });
    if (hasOther) note("orthographic cameras are left out");
}

}  // namespace

Expected<SceneFile> readGltf(const std::string& path)
{
    const DefaultFloatingPoint environment;
    tinygltf::Model model;
    if (const Expected<void> parsed = parseGltf(path, model); !parsed) return fail(oneLine(parsed.error().message));
    Expected<SceneFile> scene = Reader(path, model).read();
    if (!scene) return fail(path + ": " + oneLine(scene.error().message));
    return scene;
}

}  // namespace relief::inline RELIEF_WIDTH
