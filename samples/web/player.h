// One stage in a page of the book: its picture for a camera and properties that the reader changes.
#pragma once

#include <optional>
#include <string>

#include "common/render.h"

namespace relief::samples {

class Player
{
public:
    // A stage of this program, by number or stem. Reads no file yet.
    static Expected<Player> open(const std::string& name);

    // What the page needs to know before it loads the stage, as JSON: {"stage": "1.08 Along v", "files": [names in
    // assets/], "properties": [{"name", "kind": "number" | "vector" | "color" | "toggle" | "choice", "value": [...],
    // "minimum", "maximum", "meaning", "choices": [...]}]}.
    std::string description() const;

    // Reads the files, from $RELIEF_ASSETS. Everything below needs it.
    Expected<void> load();

    // The views of what lies behind the picture, as JSON: [{"name", "meaning"}].
    Expected<std::string> views() const;

    // "name=value"; and all properties and the camera as the stage has them.
    Expected<void> set(const std::string& setting);
    void reset();

    // By degrees; by a factor of the distance; by parts of the picture's height.
    void orbit(float yaw, float pitch);
    void zoom(float factor);
    void move(float right, float up);

    // Where it stands and what it looks at, as JSON: [x, y, z, x, y, z]. Another player takes it.
    std::string camera() const;
    Expected<void> look(const std::string& camera);

    // The picture, or a view (common/inside.h), as R, G, B, A, rows from the top.
    Expected<Framebuffer> render(int width, int height, const std::string& view) const;

    // The hash of the stage's golden (tests/golden/hashes.txt): of the stage as it is by default, whatever was changed.
    Expected<std::string> restingHash() const;

    const PreparedStage& prepared() const { return *stage; }

private:
    const Stage* source = nullptr;
    std::optional<PreparedStage> stage;  // once it is loaded
};

}  // namespace relief::samples
