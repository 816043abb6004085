// The review page in Chromium: what it shows are the pictures' values, and keys make the list that `check accept`
// takes.
#if defined(RELIEF_CHROMEDRIVER)

#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "live_command.h"
#include "png16.h"
#include "relief/texture/image.h"
#include "webdriver.h"

namespace {

namespace fs = std::filesystem;
using namespace relief;

const std::string kLeft = "\uE012", kRight = "\uE014", kDown = "\uE015";

// One golden of each kind, broken on purpose, and one that is met.
void writePictures(const TemporaryFolder& folder)
{
    for (const char* name : {"actual", "golden"}) fs::create_directories(folder / name);
    constexpr int kWidth = 40, kHeight = 30;
    std::vector<std::uint8_t> golden;
    for (int i = 0; i < kWidth * kHeight; ++i) {
        for (const int value : {i * 5, i / 3, 200 - i / 7, i % 4 == 0 ? 7 : 255})
            golden.push_back(static_cast<std::uint8_t>(value));
    }
    std::vector<std::uint8_t> actual = golden;
    for (const int pixel : {83, 84, 700})
        actual[static_cast<std::size_t>(pixel) * 4 + 1] ^= 0x15;  // (3, 2), (4, 2), (20, 17)
    actual[84 * 4 + 3] = 8;                                       // alpha 7
    const auto write = [&](const std::string& name, const std::vector<std::uint8_t>& pixels) {
        REQUIRE(writePng(folder / name, kWidth, kHeight, pixels));
    };
    write("actual/8 bits.png", actual);
    write("golden/8 bits.png", golden);
    write("actual/met.png", golden);
    write("golden/met.png", golden);
    write("actual/missing.png", golden);
    write("actual/size.png", golden);
    REQUIRE(writePng(folder / "golden/size.png", 1, 1, std::vector<std::uint8_t>(4, 9)));
    write("actual/unreadable.png", golden);
    folder.write("golden/unreadable.png", "</script><b>no picture");
    write("golden/unused.png", golden);
    folder.write("actual/sixteen.png", png16(3, 1, {1, 500, 65535}));
    folder.write("golden/sixteen.png", png16(3, 1, {1, 1000, 65535}));
    REQUIRE(writePfm(folder / "golden/floats.pfm", 2, 1, std::vector<float>{0.5f, -1.0f, 1e-30f, 2.0f, 0.1f, 0.0f}));
    REQUIRE(writePfm(folder / "actual/floats.pfm", 2, 1,
                     std::vector<float>{0.5f, -1.0f, 1e-30f, std::nextafter(2.0f, 3.0f), 0.1f, -0.0f}));
}

std::string rowOf(WebDriver& browser, const std::string& id)
{
    return browser.text("return [...document.getElementById('" + id + "').cells].map(c => c.innerText).join(' ')");
}

// Shows the case of this name.
void show(WebDriver& browser, const std::string& name)
{
    CAPTURE(name);
    REQUIRE(browser.run("const all = [...document.querySelectorAll('#list button')];"
                        "const i = all.findIndex(b => b.firstChild.textContent == arguments[0]);"
                        "if (i >= 0) all[i].click(); window.wanted = i; return i >= 0;",
                        {name}) == WebDriver::Json(true));
    REQUIRE(browser.wait("return document.body.dataset.ready === String(window.wanted)"));
}

}  // namespace

TEST_CASE("check page: a person reviews one golden of each kind by keys, and accepts two of them")
{
    const TemporaryFolder folder;
    writePictures(folder);
    unsetenv("CI");
    CHECK(
        runCommand(folder, "check folder actual golden --failures failures --junit junit.xml", "relief_goldens").code ==
        1);
    CHECK(runCommand(folder, "check review failures -o review.html", "relief_goldens").code == 0);
    CHECK(contents(folder / "out.txt") == "review.html: 7 of 8 goldens to look at\n");
    // Everything is in the file.
    const std::string page = contents(folder / "review.html");
    for (const char* word : {"src=", "href=", "http:", "https:", "import "}) {
        CAPTURE(word);
        CHECK(page.find(word) == std::string::npos);
    }

    WebDriver browser(folder.path);
    browser.open(folder / "review.html");
    REQUIRE(browser.wait("return document.body.dataset.ready === '0'"));
    CHECK(browser.text("return document.querySelectorAll('b').length + ''") == "7");  // no tag of a message

    // First what cannot be compared, then by the number of pixels that differ.
    CHECK(browser.text("return [...document.querySelectorAll('#list span')].map(s => s.textContent).join()") ==
          "missing.png,size.png,unreadable.png,unused.png,8 bits.png,floats.pfm,sixteen.png");

    // The magnifier begins at the first difference, and its values are the pictures', under alpha too.
    show(browser, "8 bits.png");
    CHECK(rowOf(browser, "golden-value") == "golden 159 27 189 255");
    CHECK(rowOf(browser, "actual-value") == "picture 159 14 189 255");
    CHECK(rowOf(browser, "difference-value") == "difference 0 13 0 0");
    browser.press({kRight});
    CHECK(browser.text("return document.getElementById('place').innerText") == "(4, 2)");
    CHECK(rowOf(browser, "golden-value") == "golden 164 28 188 7");
    CHECK(rowOf(browser, "actual-value") == "picture 164 9 188 8");
    browser.press({"n"});
    CHECK(browser.text("return document.getElementById('place').innerText") == "(20, 17)");
    browser.press({kLeft, kDown});
    CHECK(rowOf(browser, "difference-value") == "difference 0 0 0 0");

    // Every pixel of both pictures, as it is drawn.
    const char* const sum =
        "const p = arguments[0] ? actual : golden; let s = 0; p.values.forEach((v, i) => { s = (s * 31 + v) % 1000003; "
        "}); return s;";
    for (const bool isActual : {false, true}) {
        const auto file = std::get<Image8>(*readImage(folder / (isActual ? "actual/8 bits.png" : "golden/8 bits.png")));
        std::uint64_t expected = 0;
        for (const std::uint8_t value : file.pixels) expected = (expected * 31 + value) % 1000003;
        CHECK(browser.run(sum, {isActual}) == WebDriver::Json(expected));
    }

    // The ways to look at them.
    const std::string captions =
        "return [...document.querySelectorAll('#stage figcaption')].map(c => c.innerText).join()";
    CHECK(browser.text(captions) == "Golden, 40x30,Picture, 40x30,Where they differ");
    const std::string pixel =
        "const c = document.querySelector('#stage canvas').getContext('2d').getImageData(20, 17, 1, 1).data; return "
        "[...c].join()";
    browser.press({"3"});
    CHECK(browser.text(captions) == "Golden");
    const std::string goldenPixel = browser.text(pixel);
    browser.press({" "});
    CHECK(browser.text(captions) == "Picture");
    CHECK(browser.text(pixel) != goldenPixel);
    browser.press({"2"});
    CHECK(browser.text("return document.getElementById('swipe').value") == "50");
    browser.press({"<", "<"});
    CHECK(browser.text("return document.getElementById('swipe').value") == "40");
    browser.press({"4"});
    CHECK(browser.wait("return document.querySelector('#stage figcaption').innerText == 'Picture'"));
    CHECK(browser.wait("return document.querySelector('#stage figcaption').innerText == 'Golden'"));
    browser.press({"5"});
    CHECK(browser.text(captions) == "Where they differ");
    browser.press({"1", "?"});
    CHECK(browser.run("return document.getElementById('keys').open") == WebDriver::Json(true));
    browser.press({"\uE00C"});  // Escape
    CHECK(browser.run("return document.getElementById('keys').open") == WebDriver::Json(false));

    show(browser, "sixteen.png");
    CHECK(rowOf(browser, "golden-value") == "golden 1000 1000 1000 65535");
    CHECK(rowOf(browser, "difference-value") == "difference 500 500 500 0");
    show(browser, "floats.pfm");
    CHECK(rowOf(browser, "golden-value") == "golden 2\n40000000 0.100000001\n3dcccccd 0\n00000000 1\n3f800000");
    CHECK(rowOf(browser, "actual-value") ==
          "picture 2.00000024\n40000001 0.100000001\n3dcccccd 0\n80000000 1\n3f800000");
    CHECK(rowOf(browser, "difference-value") == "ULP 1 0 1 0");
    for (const char* name : {"size.png", "missing.png", "unreadable.png", "unused.png"}) {
        show(browser, name);
        CHECK(rowOf(browser, "difference-value") == "difference – – – –");
    }

    // J and K, A, R and U.
    show(browser, "missing.png");
    browser.press({"a"});
    REQUIRE(browser.wait("return document.body.dataset.ready === '1'"));
    browser.press({"r"});
    REQUIRE(browser.wait("return document.body.dataset.ready === '2'"));
    browser.press({"a"});
    REQUIRE(browser.wait("return document.body.dataset.ready === '3'"));
    browser.press({"u"});
    REQUIRE(browser.wait("return document.body.dataset.ready === '2'"));
    browser.press({"j", "j"});
    REQUIRE(browser.wait("return document.body.dataset.ready === '4'"));
    browser.press({"k", "j"});
    REQUIRE(browser.wait("return document.body.dataset.ready === '4'"));
    browser.press({"a"});
    CHECK(
        browser.wait("return document.getElementById('summary').textContent == '7 of 8 to look at: 2 accepted, 1 "
                     "rejected, 4 open'"));
    browser.press({"s"});
    for (int i = 0; i < 100 && !fs::exists(folder / "accept.json"); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    REQUIRE(fs::exists(folder / "accept.json"));
    const Outcome accepted = runCommand(folder, "check accept accept.json", "relief_goldens");
    CAPTURE(accepted.err);
    CHECK(accepted.code == 0);
    const std::string golden = (folder / "golden").string();
    CHECK(accepted.out == "accepted: " + golden + "/missing.png\naccepted: " + golden + "/8 bits.png\n");
    CHECK(contents(folder / "golden/8 bits.png") == contents(folder / "actual/8 bits.png"));

    // JUnit's XML, by the browser's parser.
    const nlohmann::json cases = browser.run(
        "const xml = new DOMParser().parseFromString(arguments[0], 'application/xml');"
        "return [xml.querySelectorAll('parsererror').length, xml.querySelectorAll('testcase').length,"
        "        xml.querySelectorAll('testcase > failure').length, "
        "xml.querySelector('testsuite').getAttribute('failures')]",
        {contents(folder / "junit.xml")});
    CHECK(cases == nlohmann::json({0, 8, 7, "7"}));
}

TEST_CASE("check page: dark where the system is dark, and readable there")
{
    const TemporaryFolder folder;
    writePictures(folder);
    CHECK(runCommand(folder, "check folder actual golden --failures failures", "relief_goldens").code == 1);
    CHECK(runCommand(folder, "check review failures -o review.html", "relief_goldens").code == 0);
    WebDriver browser(folder.path, true);
    browser.open(folder / "review.html");
    REQUIRE(browser.wait("return document.body.dataset.ready === '0'"));
    // Contrast of text to its background (WCAG 2.1, 1.4.3), at least 4.5.
    const std::string contrast =
        "const light = color => { const c = color.match(/[\\d.]+/g).slice(0, 3).map(v => { v /= 255;"
        "  return v <= .03928 ? v / 12.92 : ((v + .055) / 1.055) ** 2.4 });"
        "  return .2126 * c[0] + .7152 * c[1] + .0722 * c[2]; };"
        "const back = e => { for (; e; e = e.parentElement) { const b = getComputedStyle(e).backgroundColor;"
        "  if (b != 'rgba(0, 0, 0, 0)') return b; } return 'rgb(255, 255, 255)'; };"
        "let least = 99;"
        "for (const e of document.querySelectorAll('h1, p, button, span, small, kbd, th, td, pre, figcaption')) {"
        "  if (e.disabled || e.closest('dialog')) continue;"
        "  const a = light(getComputedStyle(e).color), b = light(back(e));"
        "  least = Math.min(least, (Math.max(a, b) + .05) / (Math.min(a, b) + .05)); }"
        "return [matchMedia('(prefers-color-scheme: dark)').matches, least]";
    const nlohmann::json dark = browser.run(contrast);
    REQUIRE(dark.is_array());
    CHECK(dark[0] == true);
    CHECK(dark[1].get<double>() >= 4.5);
}

#endif
