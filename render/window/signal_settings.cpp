#include "render/window/signal_settings.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <xcb/randr.h>

#include "render/window/program_answer.h"
#include "render/window/xcb_reply.h"

namespace overt {
namespace {

/// A matrix of colours has 9 numbers of 64 bits.
constexpr int most_numbers = 18;

std::string text_of(xcb_connection_t* link, xcb_atom_t atom) {
    const auto name = owned(xcb_get_atom_name_reply(link, xcb_get_atom_name(link, atom), nullptr));
    return name ? std::string(xcb_get_atom_name_name(name.get()),
                              static_cast<std::size_t>(xcb_get_atom_name_name_length(name.get())))
                : std::string();
}

template <class Number>
std::string numbers_of(const xcb_randr_get_output_property_reply_t& value, const std::uint8_t* data) {
    std::vector<std::int64_t> numbers;
    for (std::uint32_t i = 0; i < value.num_items; ++i) {
        Number number{};
        std::memcpy(&number, data + i * sizeof number, sizeof number);
        numbers.push_back(number);
    }
    return fmt::format("{}", fmt::join(numbers, " "));
}

/// Nothing of what is no word and no few numbers.
std::optional<std::string> value_of(xcb_connection_t* link, xcb_randr_output_t output, xcb_atom_t property) {
    const auto value = owned(xcb_randr_get_output_property_reply(
        link, xcb_randr_get_output_property(link, output, property, XCB_ATOM_ANY, 0, most_numbers + 1, 0, 0),
        nullptr));
    if (!value || value->num_items == 0 || value->num_items > most_numbers || value->bytes_after > 0)
        return std::nullopt;
    const std::uint8_t* const data = xcb_randr_get_output_property_data(value.get());
    const bool is_signed = value->type == XCB_ATOM_INTEGER;
    if (value->format == 32 && value->type == XCB_ATOM_ATOM) {
        std::vector<std::string> words;
        for (std::uint32_t i = 0; i < value->num_items; ++i) {
            xcb_atom_t atom = XCB_ATOM_NONE;
            std::memcpy(&atom, data + i * sizeof atom, sizeof atom);
            words.push_back(text_of(link, atom));
        }
        return fmt::format("{}", fmt::join(words, " "));
    }
    if (value->format == 32)
        return is_signed ? numbers_of<std::int32_t>(*value, data) : numbers_of<std::uint32_t>(*value, data);
    if (value->format == 16)
        return is_signed ? numbers_of<std::int16_t>(*value, data) : numbers_of<std::uint16_t>(*value, data);
    return std::nullopt;
}

struct FoundOutput {
    xcb_randr_output_t output = 0;
    xcb_randr_crtc_t crtc = 0;
};

std::optional<FoundOutput> output_called(xcb_connection_t* link, const std::string& name) {
    for (auto roots = xcb_setup_roots_iterator(xcb_get_setup(link)); roots.rem; xcb_screen_next(&roots)) {
        const auto resources = owned(xcb_randr_get_screen_resources_current_reply(
            link, xcb_randr_get_screen_resources_current(link, roots.data->root), nullptr));
        if (!resources)
            continue;
        const xcb_randr_output_t* const outputs =
            xcb_randr_get_screen_resources_current_outputs(resources.get());
        for (int i = 0; i < xcb_randr_get_screen_resources_current_outputs_length(resources.get()); ++i) {
            const auto info = owned(xcb_randr_get_output_info_reply(
                link, xcb_randr_get_output_info(link, outputs[i], XCB_CURRENT_TIME), nullptr));
            if (info && name_of(*info) == name)
                return FoundOutput{outputs[i], info->crtc};
        }
    }
    return std::nullopt;
}

std::string rotation_word(std::uint16_t rotation) {
    constexpr std::pair<int, const char*> words[] = {
        {XCB_RANDR_ROTATION_ROTATE_0, "normal"},     {XCB_RANDR_ROTATION_ROTATE_90, "left"},
        {XCB_RANDR_ROTATION_ROTATE_180, "inverted"}, {XCB_RANDR_ROTATION_ROTATE_270, "right"},
        {XCB_RANDR_ROTATION_REFLECT_X, "x"},         {XCB_RANDR_ROTATION_REFLECT_Y, "y"}};
    std::vector<const char*> said;
    for (const auto& [bit, word] : words)
        if ((rotation & bit) != 0)
            said.push_back(word);
    return fmt::format("{}", fmt::join(said, " "));
}

bool is_identity(const xcb_render_transform_t& matrix) {
    constexpr xcb_render_fixed_t one = 1 << 16;
    return matrix.matrix11 == one && matrix.matrix12 == 0 && matrix.matrix13 == 0 && matrix.matrix21 == 0 &&
           matrix.matrix22 == one && matrix.matrix23 == 0 && matrix.matrix31 == 0 && matrix.matrix32 == 0 &&
           matrix.matrix33 == one;
}

void add_crtc_settings(xcb_connection_t* link, xcb_randr_crtc_t crtc, std::vector<SignalSetting>& settings) {
    using enum SignalSetting::Source;
    if (const auto info = owned(xcb_randr_get_crtc_info_reply(
            link, xcb_randr_get_crtc_info(link, crtc, XCB_CURRENT_TIME), nullptr)))
        settings.push_back({"rotation", rotation_word(info->rotation), randr_crtc});
    if (const auto transform = owned(
            xcb_randr_get_crtc_transform_reply(link, xcb_randr_get_crtc_transform(link, crtc), nullptr)))
        settings.push_back(
            {"transformation", is_identity(transform->current_transform) ? "none" : "another", randr_crtc});
}

} // namespace

std::vector<SignalSetting> read_nvidia_settings(const std::string& output, const std::string& program) {
    std::vector<SignalSetting> settings;
    for (const char* const name : {"ColorRange", "ColorSpace", "CurrentDithering"}) {
        const std::optional<std::string> answer =
            program_answer({program, "-t", "-q", fmt::format("[dpy:{}]/{}", output, name)});
        if (!answer)
            return {{"nvidia-settings", "does not answer", SignalSetting::Source::nvidia}};
        const std::size_t end = answer->find_first_of("\r\n");
        settings.push_back({name, answer->substr(0, end), SignalSetting::Source::nvidia});
    }
    return settings;
}

std::vector<SignalSetting> read_signal_settings(const std::string& output,
                                                const std::string& nvidia_settings) {
    const XcbLink link = link_to(nullptr);
    if (!begin_randr(link.get()))
        return {};
    const std::optional<FoundOutput> found = output_called(link.get(), output);
    if (!found)
        return {};
    std::vector<SignalSetting> settings;
    if (found->crtc != 0)
        add_crtc_settings(link.get(), found->crtc, settings);
    if (const auto properties = owned(xcb_randr_list_output_properties_reply(
            link.get(), xcb_randr_list_output_properties(link.get(), found->output), nullptr))) {
        const std::span atoms(
            xcb_randr_list_output_properties_atoms(properties.get()),
            static_cast<std::size_t>(xcb_randr_list_output_properties_atoms_length(properties.get())));
        for (const xcb_atom_t atom : atoms)
            if (auto value = value_of(link.get(), found->output, atom))
                settings.push_back(
                    {text_of(link.get(), atom), *std::move(value), SignalSetting::Source::randr});
    }
    if (has_extension(link.get(), "NV-CONTROL")) {
        const std::vector<SignalSetting> more = read_nvidia_settings(output, nvidia_settings);
        settings.insert(settings.end(), more.begin(), more.end());
    }
    return settings;
}

} // namespace overt
