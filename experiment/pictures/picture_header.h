/// What a picture's file says before its values.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <glm/glm.hpp>

namespace overt {

/// How values stand in a file or in memory: whole numbers without a sign, or floats after IEEE 754.
enum class PixelType : std::uint8_t { bits8, bits16, bits32, float16, float32, other };

using PictureAttribute = std::variant<int, double, glm::dvec3, std::string>;

struct PictureHeader {
    glm::ivec2 size_px{0};
    std::vector<std::string> channels;
    PixelType type = PixelType::other;
    int alpha_channel = -1;
    /// Named as OpenImageIO names them; those of other types than an attribute can have are left out.
    std::vector<std::pair<std::string, PictureAttribute>> attributes = {};

    // Of files that are read.
    std::string format = {}; ///< "openexr", "radiance", …, as OpenImageIO names them
    /// CIE 1931 x and y of red, green, blue and white, if the file says what its colours are.
    std::optional<std::array<double, 8>> primaries = {};
    glm::ivec2 stored_px{0};      ///< what is read at once, where that is not the picture itself
    std::string type_name = {};   ///< for people
    glm::ivec2 tile_px{0};        ///< 0: not in tiles
    bool channels_differ = false; ///< in their type
    bool is_deep_or_volume = false;

    int channel_count() const { return static_cast<int>(channels.size()); }

    /// Nothing if there is none of this name and type.
    template <class Value> const Value* attribute(std::string_view name) const {
        for (const auto& [key, value] : attributes)
            if (key == name)
                return std::get_if<Value>(&value);
        return nullptr;
    }
    /// Empty if there is none.
    std::string text(std::string_view name) const {
        const auto* const found = attribute<std::string>(name);
        return found ? *found : std::string();
    }
    /// Number of a channel; -1 if there is none of this name.
    int channel(std::string_view name) const {
        const auto found = std::find(channels.begin(), channels.end(), name);
        return found == channels.end() ? -1 : static_cast<int>(found - channels.begin());
    }
};

} // namespace overt
