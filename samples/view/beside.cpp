// Of the viewer: the picture beside the stage's own, and what becomes of the two.
#include <algorithm>
#include <cmath>

#include "view/stage_list.h"
#include "view/viewer.h"

namespace relief::samples {

void Viewer::changed()
{
    composedIsOld = differenceIsOld = true;
    ++version;
}

void Viewer::setBeside(Beside its, std::string name)
{
    if (its != Beside::golden && sizeBefore) {
        fit = sizeBefore->fit;
        wanted.width = sizeBefore->width;
        wanted.height = sizeBefore->height;
        sizeBefore.reset();
        ask();
    }
    kind = its;
    otherName = std::move(name);
    if (kind != Beside::stage && kind != Beside::goal) second.reset();
    if (kind == Beside::nothing) other = {};
    changed();
}

Expected<void> Viewer::compareWith(const live::StageSource& source)
{
    // Its properties and views are not known yet: ask() asks for those that it has.
    live::Look its = wanted;
    its.settings.clear();
    its.files = {};
    its.show.clear();
    if (source.folder != current->source().folder) its.camera.reset();
    Expected<std::unique_ptr<live::Session>> opened = live::Session::open(source, its, maker, compiler);
    if (!opened) return tl::unexpected(opened.error());
    second = std::move(*opened);
    other = {};
    setBeside(Beside::stage, source.id.empty() ? source.stem : source.id);
    return {};
}

Expected<void> Viewer::compareWithGolden()
{
    Expected<Pixels> golden = readPixels(goldenOf(current->source()));
    if (!golden) return tl::unexpected(golden.error());
    other = std::move(*golden);
    if (!sizeBefore) sizeBefore = {fit, wanted.width, wanted.height};
    fit = Fit::fixed;
    wanted.width = other.width;
    wanted.height = other.height;
    setBeside(Beside::golden, "golden");
    ask();
    return {};
}

// The answer's picture, drawn as this one is: from the same side, with the same properties.
Expected<void> Viewer::compareWithGoal()
{
    if (!goal) return {};
    const Expected<void> opened = compareWith(*goal);
    if (!opened) return opened;
    setBeside(Beside::goal, "goal");
    setGrid(true);
    return {};
}

void Viewer::compareWithSnapshot(std::size_t index)
{
    if (index >= snapshots.size()) return;
    other = snapshots[index].picture;
    setBeside(Beside::snapshot, snapshots[index].name);
}

void Viewer::compareWithStageBefore()
{
    if (kind != Beside::nothing) return compareWithNothing();
    const std::vector<live::StageSource>& all = live::stageSources();
    for (std::size_t i = 1; i < all.size(); ++i) {
        if (all[i].path != current->source().path) continue;
        if (const Expected<void> opened = compareWith(all[i - 1]); !opened) refusal = opened.error().message;
    }
}

void Viewer::compareWithNothing()
{
    setBeside(Beside::nothing, "");
}

void Viewer::keepSnapshot()
{
    if (own.empty()) return;
    snapshots.push_back({"kept " + std::to_string(snapshots.size() + 1) + ", " + name(), own});
}

void Viewer::setDivider(float fraction)
{
    dividerAt = std::clamp(fraction, 0.0f, 1.0f);
    changed();
}

void Viewer::setDifference(bool shown)
{
    differenceShown = shown;
    gridShown = false;
    changed();
}

void Viewer::setGrid(bool shown)
{
    gridShown = shown;
    differenceShown = false;
    changed();
}

void Viewer::setEnlargement(int factor)
{
    enlarged = std::clamp(factor, 1, 255);
    changed();
}

int Viewer::dividerColumn() const
{
    return static_cast<int>(std::lround(static_cast<float>(own.width) * dividerAt));
}

const Difference& Viewer::difference()
{
    if (differenceIsOld) lastDifference = differenceOf(own, other, enlarged);
    differenceIsOld = false;
    return lastDifference;
}

const Pixels& Viewer::shown()
{
    if (!canCompare()) return own;
    if (differenceShown) return difference().picture;
    if (composedIsOld && gridShown) composed = grid(other, own, difference().picture);
    if (composedIsOld && !gridShown) composed = beside(other, own, dividerColumn());
    composedIsOld = false;
    return composed;
}

const Pixels& Viewer::pointable()
{
    return showsGrid() ? own : shown();
}

}  // namespace relief::samples
