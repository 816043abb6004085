#include "doctor/doctor.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "doctor/marks.h"

namespace relief::samples::doctor {

namespace {

// Where a verdict begins: sound maps and faults of tests/doctor lie on both sides. How often it is right:
// docs/report/doctor.md.
constexpr double kUnit = 0.02;       // the mean error of length that 8-bit codes do not explain (they give 0.004)
constexpr double kUnitAgain = 0.04;  // and that a map may have where a cause was undone
constexpr double kUnitInBlocks = 0.08;
constexpr double kAveraged = 0.4;   // how short a normal is beside how its neighbours differ: correlation
constexpr double kMirrored = -0.3;  // curlCorrelation
constexpr double kOfASurface = 0.3;
constexpr double kBelow = 0.0005;      // part of the texels
constexpr double kBias = 3.0 / 255.0;  // of a flat x or y, beyond that of 127 or 128
constexpr double kMissing = 0.1;       // part of the codes
constexpr double kBlocks = 1.45;       // kinks at every eighth line
constexpr double kFewColors = 0.8;
constexpr double kSeam = 1.6;

std::string format(const char* words, double a, double b = 0.0, double c = 0.0)
{
    char text[256];
    std::snprintf(text, sizeof text, words, a, b, c);
    return text;
}

struct Lengths
{
    double meanError = 0.0, least = 1e9, most = 0.0;
};

Lengths lengthsOf(const NormalField& field)
{
    Lengths lengths;
    double count = 0.0;
    for (const Vector& n : field.normals) {
        if (isBackground(n)) continue;
        ++count;
        const double length = lengthOf(n);
        lengths.meanError += std::abs(length - 1.0);
        lengths.least = std::min(lengths.least, length);
        lengths.most = std::max(lengths.most, length);
    }
    if (count == 0.0) return {0.0, 1.0, 1.0};
    lengths.meanError /= count;
    return lengths;
}

double deviation(const Channels& p, std::size_t channel)
{
    double sum = 0.0, squares = 0.0;
    for (const auto& t : p.texels) {
        sum += t[channel];
        squares += static_cast<double>(t[channel]) * t[channel];
    }
    const auto count = static_cast<double>(p.texels.size());
    return std::sqrt(std::max(0.0, squares / count - sum / count * (sum / count)));
}

bool isGrey(const Channels& p)
{
    return std::all_of(p.texels.begin(), p.texels.end(), [](const auto& t) { return t[0] == t[1] && t[1] == t[2]; });
}

// x in alpha: alpha says something, and red nothing of its own.
bool isAlphaGreen(const Channels& p)
{
    if (deviation(p, 3) <= p.step * 0.5 || deviation(p, 1) <= p.step * 0.25) return false;
    const bool redIsGreen =
        std::all_of(p.texels.begin(), p.texels.end(), [](const auto& t) { return std::abs(t[0] - t[1]) < 0.02f; });
    return deviation(p, 0) < 0.01 || redIsGreen;
}

Transfer likeliestTransfer(const Channels& p)
{
    const double asIs = lengthsOf(fieldOf(p, Layout::rgb, Transfer::none)).meanError;
    Transfer best = Transfer::none;
    double least = asIs;
    for (const Transfer transfer : {Transfer::wasEncoded, Transfer::wasDecoded}) {
        const double error = lengthsOf(fieldOf(p, Layout::rgb, transfer)).meanError;
        if (error < least) {
            least = error;
            best = transfer;
        }
    }
    return asIs > kUnit && least < kUnitAgain && least < 0.5 * asIs ? best : Transfer::none;
}

Vector meanOf(const NormalField& field)
{
    std::array<double, 3> sum{};
    double count = 1e-9;
    for (const Vector& n : field.normals) {
        if (isBackground(n)) continue;
        ++count;
        for (std::size_t c = 0; c < 3; ++c) sum[c] += n[c];
    }
    return {static_cast<float>(sum[0] / count), static_cast<float>(sum[1] / count), static_cast<float>(sum[2] / count)};
}

double partBelow(const NormalField& field)
{
    const auto below =
        std::count_if(field.normals.begin(), field.normals.end(), [](const Vector& n) { return n[2] < -0.02f; });
    return static_cast<double>(below) / static_cast<double>(field.normals.size());
}

// Sets kind, layout, transfer. Returns the picture's vectors.
NormalField classify(const Channels& p, Diagnosis& d)
{
    if (isGrey(p)) {
        d.kind = Kind::heights;
        d.kindEvidence = "red, green and blue are the same in every texel";
        return {};
    }
    if (isAlphaGreen(p)) {
        d.kind = Kind::tangentSpace;
        d.layout = Layout::alphaGreen;
        d.kindEvidence = "x is in alpha and y in green; red has nothing of its own";
        return fieldOf(p, Layout::alphaGreen, Transfer::none);
    }
    if (const auto& background = p.background) {
        d.notes.push_back(format("texels of the colour (%.0f, %.0f, %.0f) are taken for unused",
                                 255.0 * (*background)[0], 255.0 * (*background)[1], 255.0 * (*background)[2]));
    }
    d.transfer = likeliestTransfer(p);
    const NormalField field = fieldOf(p, Layout::rgb, d.transfer);
    const Vector mean = meanOf(field);
    const Lengths lengths = lengthsOf(field);
    const double below = partBelow(field);
    d.kindEvidence = format("%.1f %% of z are above 0, the mean z is %.2f, lengths are %.3f from 1 on average",
                            100.0 * (1.0 - below), mean[2], lengths.meanError);
    // Colours have no direction in common; what only lost its length still leans to all sides, and up on average.
    const bool isUpright =
        below < 0.3 && mean[2] > 0.3f && std::hypot(mean[0], mean[1]) < 0.15 && lengths.meanError < 0.6;
    if (isUpright || (below < 0.3 && mean[2] > 0.35f && lengths.meanError < 0.25)) {
        d.kind = Kind::tangentSpace;
        return field;
    }
    // Directions to all sides: only their lengths tell them from colours.
    const bool isUnit = d.transfer == Transfer::none && lengths.meanError < 0.1;
    d.kind = isUnit ? Kind::objectSpace : Kind::noMap;
    d.transfer = Transfer::none;
    return field;
}

// --- the faults of a tangent-space map, in the order in which they are cured ---

struct Patient
{
    const Channels& picture;
    const Given& given;
    Diagnosis& d;
    NormalField field;
    Blocks blocks;

    bool isCompressed() const { return blocks.fewColors > kFewColors || std::max(blocks.eight, blocks.four) > kBlocks; }

    std::string fix() const { return "./relief doctor " + given.name + " --fix cured.png"; }
    void add(Fault fault, std::string words, std::string evidence)
    {
        d.findings.push_back({fault, std::move(words), std::move(evidence), fix(), true});
    }
    void addIncurable(Fault fault, std::string words, std::string evidence, std::string remedy)
    {
        d.findings.push_back({fault, std::move(words), std::move(evidence), std::move(remedy), false});
    }
};

void examineStorage(Patient& p)
{
    if (p.d.layout == Layout::alphaGreen)
        p.add(Fault::alphaGreen, "x is stored in alpha (DXT5nm); z is not stored", p.d.kindEvidence);
    if (p.d.transfer == Transfer::none) return;
    const double now = lengthsOf(p.field).meanError;
    const double before = lengthsOf(fieldOf(p.picture, p.d.layout, Transfer::none)).meanError;
    const std::string evidence =
        format("lengths are %.3f from 1 on average, and %.3f when that is undone", before, now);
    if (p.d.transfer == Transfer::wasEncoded)
        p.add(Fault::wasEncoded, "the codes were encoded as sRGB, as colours are: flat is 188, not 128", evidence);
    else
        p.add(Fault::wasDecoded, "the codes were decoded from sRGB, as colours are: flat is 55, not 128", evidence);
}

// The code that most texels have, if it is that of a flat surface.
void examineFlat(Patient& p)
{
    std::map<std::pair<int, int>, int> count;
    std::array<double, 2> slope{};
    double all = 0.0;
    for (const Vector& n : p.field.normals) {
        if (isBackground(n)) continue;
        ++all;
        ++count[{static_cast<int>(std::lround((n[0] * 0.5f + 0.5f) * 255.0f)),
                 static_cast<int>(std::lround((n[1] * 0.5f + 0.5f) * 255.0f))}];
        for (std::size_t c = 0; c < 2; ++c) slope[c] += n[c];
    }
    if (count.empty()) return;
    const auto most =
        std::max_element(count.begin(), count.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    std::array<double, 2> flat = {most->first.first / 127.5 - 1.0, most->first.second / 127.5 - 1.0};
    std::string evidence = format("%.0f %% of all texels have red and green (%.0f, %.0f)", 100.0 * most->second / all,
                                  most->first.first, most->first.second);
    // A flat part has one code; the sides of ridges or of pyramids have several that are as common.
    const bool isAlone = std::all_of(count.begin(), count.end(), [&](const auto& other) {
        const auto& [code, texels] = other;
        const int apart =
            std::max(std::abs(code.first - most->first.first), std::abs(code.second - most->first.second));
        return apart <= 2 || 2 * texels < most->second;
    });
    if (most->second < 0.1 * all || !isAlone) {
        // No flat part: a surface that repeats goes up as far as it goes down.
        const Seam seam = seamOf(p.picture);
        if (std::max(seam.leftRight, seam.bottomTop) > kSeam) return;
        flat = {slope[0] / all, slope[1] / all};
        evidence = format("the mean of x is %.4f, of y %.4f; a surface that repeats has 0", flat[0], flat[1]);
    }
    const auto beyond = [](double value) { return std::max(0.0, std::abs(value) - 1.0 / 255.0); };
    if (std::max(beyond(flat[0]), beyond(flat[1])) < kBias) return;
    if (std::max(std::abs(flat[0]), std::abs(flat[1])) > 0.3) return;  // a slope, not a shifted code
    p.d.bias = {static_cast<float>(flat[0]), static_cast<float>(flat[1])};
    const double degrees = std::asin(std::min(1.0, std::hypot(flat[0], flat[1]))) * 57.29578;
    p.add(Fault::notFlat, "flat is not (128, 128)",
          evidence + format("; a flat surface leans by %.1f degrees", degrees));
    for (Vector& n : p.field.normals) {
        n[0] -= p.d.bias[0];
        n[1] -= p.d.bias[1];
    }
}

void examineBelow(Patient& p)
{
    const double below = partBelow(p.field);
    if (below < kBelow) return;
    p.add(Fault::belowSurface, "some normals point below the surface: z is below 0",
          format("%.2f %% of the texels", 100.0 * below));
    for (Vector& n : p.field.normals) n[2] = std::abs(n[2]);
}

// Why lengths are too short: the directions around differ (averaging), or the texel itself leans (x and y were scaled).
void examineLengths(Patient& p)
{
    if (p.d.layout == Layout::alphaGreen) return;
    const Lengths lengths = lengthsOf(p.field);
    std::vector<float> missing, variety, lean;
    for (int y = 0; y < p.field.height; ++y) {
        for (int x = 0; x < p.field.width; ++x) {
            const auto unit = [&](int i, int j) {
                Vector n = p.field.normals[p.field.at(i, j)];
                const float length = std::max(lengthOf(n), 1e-6f);
                for (float& c : n) c /= length;
                return n;
            };
            const Vector n = unit(x, y);
            Vector sum = n;
            for (const auto& other : {unit(x + 1, y), unit(x - 1, y), unit(x, y + 1), unit(x, y - 1)}) {
                for (std::size_t c = 0; c < 3; ++c) sum[c] += other[c];
            }
            missing.push_back(1.0f - lengthOf(p.field.normals[p.field.at(x, y)]));
            variety.push_back(1.0f - lengthOf(sum) / 5.0f);
            lean.push_back(1.0f - n[2]);
        }
    }
    const auto centred = [](std::vector<float>& list) {
        double mean = 0.0;
        for (const float v : list) mean += v;
        mean /= static_cast<double>(list.size());
        for (float& v : list) v -= static_cast<float>(mean);
    };
    for (auto* list : {&missing, &variety, &lean}) centred(*list);
    const double byVariety = fit(variety, missing).correlation, byLean = fit(lean, missing).correlation;
    const std::string evidence = format("lengths go from %.3f to %.3f and are %.3f from 1 on average", lengths.least,
                                        lengths.most, lengths.meanError);
    const bool isAveraged = lengths.most < 1.02 && byVariety > kAveraged && byVariety > byLean && !p.isCompressed();
    const double allowed = p.isCompressed() ? kUnitInBlocks : kUnit;
    if (isAveraged) {
        p.add(Fault::averaged, "normals were averaged and not made unit length again, as mip levels are",
              evidence + format(", short where directions differ (correlation %.2f)", byVariety));
    } else if (lengths.meanError > allowed) {
        p.add(Fault::notUnit, "normals are not of unit length", evidence);
    }
}

void makeUnit(NormalField& field)
{
    for (Vector& n : field.normals) {
        const float length = lengthOf(n);
        if (length < 1e-6f)
            n = {0, 0, 1};
        else
            for (float& c : n) c /= length;
    }
}

void mirror(NormalField& field, std::size_t axis)
{
    for (Vector& n : field.normals) n[axis] = -n[axis];
}

// Against heights: which way each axis goes, and how strong the map is beside them.
bool examineAgainstHeights(Patient& p, const Slopes& slopes)
{
    const Channels& heights = *p.given.heights;
    const Slopes wanted = slopesOfHeights(heights, 1.0f);
    const Fit u = fit(wanted.u, slopes.u), v = fit(wanted.v, slopes.v);
    const std::string evidence =
        format("slopes and the heights' own: correlation %.2f along u, %.2f along v", u.correlation, v.correlation);
    if (std::abs(u.correlation) < 0.3 || std::abs(v.correlation) < 0.3) {
        p.d.notes.push_back("the given heights are not of this map: " + evidence);
        return false;
    }
    const bool red = u.correlation < 0.0, green = v.correlation < 0.0;
    if (red && green)
        p.add(Fault::bothMirrored, "red and green are mirrored: the map's bumps are the heights' dents", evidence);
    else if (red)
        p.add(Fault::redMirrored, "red is mirrored: left and right are exchanged", evidence);
    else if (green)
        p.add(Fault::greenMirrored, "green is upside down", evidence);
    if (red) mirror(p.field, 0);
    if (green) mirror(p.field, 1);
    const double scaleU = std::abs(u.factor), scaleV = std::abs(v.factor);
    p.d.notes.push_back(format("the given heights, 0 to 1, are %.2f texels high in this map", 0.5 * (scaleU + scaleV)));
    if (std::max(scaleU, scaleV) > 1.15 * std::min(scaleU, scaleV)) {
        p.addIncurable(Fault::wrongScale, "the two axes have different strengths",
                       format("heights are %.2f texels high along u and %.2f along v", scaleU, scaleV),
                       "make the map again, with one scale");
    }
    return true;
}

void examineMirrors(Patient& p)
{
    const Slopes slopes = slopesOf(p.field);
    p.d.curl = curlCorrelation(slopes);
    const bool fits =
        p.given.heights && p.given.heights->width == p.field.width && p.given.heights->height == p.field.height;
    if (p.given.heights && !fits) p.d.notes.push_back("the given heights have another size and were not used");
    if (fits && examineAgainstHeights(p, slopes)) return;
    const std::string evidence =
        format("du/dv and dv/du of the slopes have the correlation %.2f; of a surface it is near 1", p.d.curl);
    if (p.d.curl < kMirrored) {
        p.add(Fault::greenMirrored, "green is upside down (or red is mirrored)",
              evidence + ". Only heights can tell which of the two; green is far more often the one");
        mirror(p.field, 1);
    } else if (p.d.curl < kOfASurface) {
        p.d.notes.push_back("whether an axis is mirrored cannot be known: " + evidence);
    }
    if (std::abs(p.d.curl) >= kOfASurface)
        p.d.notes.push_back(
            "bumps or dents cannot be known without heights: with both axes mirrored it is a sound map of the "
            "opposite");
}

// --- what shows in the codes themselves, of any kind of map ---

void examineMarks(Patient& p)
{
    // sRGB and blocks leave codes out, too, and blocks do not go on at the sides: those are named already.
    const Levels levels = levelsOf(p.picture, p.d.layout);
    if (levels.missing > kMissing && p.d.transfer == Transfer::none && !p.isCompressed()) {
        p.addIncurable(Fault::missingLevels, "codes are missing: it was quantised twice, or stretched",
                       format("%.0f %% of the codes between others are never used; the next is %.1f away on average",
                              100.0 * levels.missing, levels.spacing),
                       "make it again from heights or normals with more bits");
    }
    const Blocks& blocks = p.blocks;
    if (blocks.fewColors > kFewColors) {
        p.addIncurable(Fault::blocks, "it was compressed in blocks of 4x4 (DXT)",
                       format("%.0f %% of the 4x4 squares that vary both ways have four colours at most",
                              100.0 * blocks.fewColors),
                       "take the picture that was compressed");
    } else if (p.isCompressed()) {
        const bool eight = blocks.eight >= blocks.four;
        p.addIncurable(Fault::blocks, eight ? "blocks of 8x8 show (JPEG)" : "blocks of 4x4 show (DXT)",
                       format("steps at every %.0fth line are %.2f times those between", eight ? 8.0 : 4.0,
                              std::max(blocks.eight, blocks.four)),
                       "take the picture that was compressed, or save it as PNG");
    }
    const Seam seam = seamOf(p.picture);
    if (std::max(seam.leftRight, seam.bottomTop) <= (p.isCompressed() ? 2.0 : 1.0) * kSeam) return;
    const std::string evidence =
        format("steps over the left and right side are %.1f times the largest others, over bottom and top %.1f",
               seam.leftRight, seam.bottomTop);
    const bool isOfOneMesh = p.d.kind == Kind::objectSpace || p.picture.background.has_value();
    if (isOfOneMesh) {
        p.d.notes.push_back("it does not repeat, and as a map of one mesh's own uv it has no need to: " + evidence);
    } else {
        p.addIncurable(Fault::seam, "it does not repeat: there is a seam at the wrap", evidence,
                       "clamp it, or make it repeat; a map of a mesh's own uv has no need to");
    }
}

// Around a front face uv run clockwise, and w is -1, but where they are mirrored (mesh/tangents.h).
void examineMeshes(Patient& p)
{
    int mirrored = 0, wrong = 0, count = 0;
    bool hasTangents = true;
    for (const Mesh& mesh : p.given.meshes) {
        hasTangents = hasTangents && !mesh.tangents.empty();
        for (std::size_t i = 0; i + 2 < mesh.indices.size() && !mesh.uvs.empty(); i += 3) {
            const std::uint32_t k[3] = {mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
            const glm::vec2 a = mesh.uvs[k[1]] - mesh.uvs[k[0]], b = mesh.uvs[k[2]] - mesh.uvs[k[0]];
            const float area = a.x * b.y - a.y * b.x;
            if (area == 0.0f) continue;
            ++count;
            mirrored += area > 0.0f;
            if (!mesh.tangents.empty()) wrong += (mesh.tangents[k[0]].w > 0.0f) != (area > 0.0f);
        }
    }
    if (p.given.meshes.empty()) return;
    if (count == 0) {
        p.d.notes.push_back("the mesh has no uv");
        return;
    }
    const std::string evidence = format("%.0f of %.0f triangles are mirrored in uv", mirrored, count);
    if (wrong > 0) {
        p.addIncurable(Fault::meshMirrored, "the signs of the mesh's tangents do not go with its uv",
                       evidence + format("; the sign of %.0f is the other one", wrong),
                       "export the tangents again, or leave them out: Relief makes them");
    } else {
        p.d.notes.push_back(
            "the mesh: " + evidence +
            (hasTangents ? ", and its tangents say so" : "; it has no tangents, and Relief makes them"));
    }
}

void measure(Patient& p)
{
    makeUnit(p.field);
    const Slopes slopes = slopesOf(p.field);
    p.d.strength = strengthOf(slopes);
    p.d.heights = integrate(slopes);
    p.d.cured = std::move(p.field);
}

}  // namespace

bool Diagnosis::has(Fault fault) const
{
    return std::any_of(findings.begin(), findings.end(), [fault](const Finding& f) { return f.fault == fault; });
}

Expected<Diagnosis> diagnose(const Channels& picture, const Given& given)
{
    if (picture.width < 8 || picture.height < 8)
        return fail(given.name + ": has " + std::to_string(picture.width) + "x" + std::to_string(picture.height) +
                    " texels; less than 8 a side say nothing");
    Diagnosis d;
    Patient p{picture, given, d, classify(picture, d), blocksOf(picture)};
    if (d.kind == Kind::tangentSpace) {
        examineStorage(p);
        examineFlat(p);
        examineBelow(p);
        examineLengths(p);
        examineMirrors(p);
    }
    if (d.kind == Kind::objectSpace) {
        examineLengths(p);
        d.notes.push_back("an object-space map fits its own mesh alone; tangent-space remedies are not for it");
    }
    if (d.kind != Kind::noMap) examineMarks(p);
    if (d.kind == Kind::tangentSpace) examineMeshes(p);
    if (d.kind == Kind::tangentSpace) {
        measure(p);
    } else if (d.kind == Kind::objectSpace) {
        makeUnit(p.field);
        d.cured = std::move(p.field);
    }
    return d;
}

const char* nameOf(Fault fault)
{
    static constexpr const char* kNames[] = {"alphaGreen", "greenMirrored", "redMirrored",   "bothMirrored",
                                             "wasEncoded", "wasDecoded",    "belowSurface",  "notFlat",
                                             "averaged",   "notUnit",       "missingLevels", "blocks",
                                             "seam",       "wrongScale",    "meshMirrored"};
    return kNames[static_cast<std::size_t>(fault)];
}

const char* nameOf(Kind kind)
{
    static constexpr const char* kNames[] = {"heights", "tangentSpace", "objectSpace", "noMap"};
    return kNames[static_cast<std::size_t>(kind)];
}

}  // namespace relief::samples::doctor
