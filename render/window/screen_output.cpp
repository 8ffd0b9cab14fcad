#include "render/window/screen_output.h"

#include <algorithm>
#include <cstring>
#include <string_view>
#include <vector>

#include <xcb/randr.h>

#include "render/window/edid.h"
#include "render/window/xcb_reply.h"

namespace overt {
namespace {

/// The first bytes of a property of an output whose items have so many bits; empty if there is no such.
std::vector<std::byte> bytes_of_property(xcb_connection_t* link, std::uint32_t output, std::string_view name,
                                         int bits, std::size_t byte_count) {
    const auto atom = owned(xcb_intern_atom_reply(
        link, xcb_intern_atom(link, 1, static_cast<std::uint16_t>(name.size()), name.data()), nullptr));
    if (!atom || atom->atom == XCB_ATOM_NONE)
        return {};
    const auto value = owned(xcb_randr_get_output_property_reply(
        link,
        xcb_randr_get_output_property(link, output, atom->atom, XCB_ATOM_ANY, 0,
                                      static_cast<std::uint32_t>(byte_count / 4), 0, 0),
        nullptr));
    if (!value || value->format != bits)
        return {};
    const auto* const data =
        reinterpret_cast<const std::byte*>(xcb_randr_get_output_property_data(value.get()));
    const auto length = static_cast<std::size_t>(xcb_randr_get_output_property_data_length(value.get()));
    return {data, data + std::min(length, byte_count)};
}

std::optional<std::uint32_t> number_of_property(xcb_connection_t* link, std::uint32_t output,
                                                std::string_view name) {
    std::uint32_t number = 0;
    const std::vector<std::byte> bytes = bytes_of_property(link, output, name, 32, sizeof number);
    if (bytes.size() < sizeof number)
        return std::nullopt;
    std::memcpy(&number, bytes.data(), sizeof number);
    return number;
}

/// Pixel clock over pixels of a refresh, borders included; interlaced modes light half of the rows at a time,
/// doubled ones all of them twice.
std::optional<double> rate_of(const xcb_randr_mode_info_t& mode) {
    double rows = mode.vtotal;
    if (mode.mode_flags & XCB_RANDR_MODE_FLAG_INTERLACE)
        rows /= 2.0;
    if (mode.mode_flags & XCB_RANDR_MODE_FLAG_DOUBLE_SCAN)
        rows *= 2.0;
    const double pixels = rows * mode.htotal;
    return pixels > 0.0 && mode.dot_clock > 0 ? std::optional(mode.dot_clock / pixels) : std::nullopt;
}

std::optional<double> rate_of_crtc(xcb_connection_t* link, const NativeWindow& window) {
    const auto resources = owned(xcb_randr_get_screen_resources_current_reply(
        link, xcb_randr_get_screen_resources_current(link, window.x11_window), nullptr));
    const auto crtc = owned(xcb_randr_get_crtc_info_reply(
        link, xcb_randr_get_crtc_info(link, window.randr_crtc, XCB_CURRENT_TIME), nullptr));
    if (!resources || !crtc)
        return std::nullopt;
    const xcb_randr_mode_info_t* const modes = xcb_randr_get_screen_resources_current_modes(resources.get());
    for (int i = 0; i < xcb_randr_get_screen_resources_current_modes_length(resources.get()); ++i)
        if (modes[i].id == crtc->mode)
            return rate_of(modes[i]);
    return std::nullopt;
}

/// What shows something with another controller's refreshes than the window's; of several outputs that mirror
/// each other, the first.
std::vector<std::string> neighbours_of(xcb_connection_t* link, const NativeWindow& window) {
    std::vector<std::string> names;
    const auto resources = owned(xcb_randr_get_screen_resources_current_reply(
        link, xcb_randr_get_screen_resources_current(link, window.x11_window), nullptr));
    const int count = resources ? xcb_randr_get_screen_resources_current_crtcs_length(resources.get()) : 0;
    for (int i = 0; i < count; ++i) {
        const std::uint32_t crtc = xcb_randr_get_screen_resources_current_crtcs(resources.get())[i];
        const auto lit = owned(xcb_randr_get_crtc_info_reply(
            link, xcb_randr_get_crtc_info(link, crtc, XCB_CURRENT_TIME), nullptr));
        if (crtc == window.randr_crtc || !lit || lit->mode == XCB_NONE || lit->num_outputs < 1)
            continue;
        const auto output = owned(xcb_randr_get_output_info_reply(
            link,
            xcb_randr_get_output_info(link, xcb_randr_get_crtc_info_outputs(lit.get())[0], XCB_CURRENT_TIME),
            nullptr));
        if (output)
            names.push_back(name_of(*output));
    }
    return names;
}

} // namespace

ScreenOutput examine_output(const NativeWindow& window) {
    ScreenOutput output;
    if (window.x11_server.empty() || window.randr_output == 0)
        return output;
    const XcbLink link = link_to(window.x11_server.c_str());
    if (!begin_randr(link.get()))
        return output;
    output.refresh_hz = rate_of_crtc(link.get(), window);
    output.neighbours = neighbours_of(link.get(), window);
    output.edid_name =
        product_name_of(bytes_of_property(link.get(), window.randr_output, "EDID", 8, edid_block_bytes));
    output.connector = number_of_property(link.get(), window.randr_output, "CONNECTOR_ID");
    if (const auto capable = number_of_property(link.get(), window.randr_output, "vrr_capable"))
        output.may_vary_its_refresh = *capable != 0;
    return output;
}

} // namespace overt
