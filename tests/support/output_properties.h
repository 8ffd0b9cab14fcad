/// Properties of an output of the graphics card, as its driver gives them to the X server.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <xcb/randr.h>

#include "render/window/xcb_reply.h"

namespace overt::test {

/// What a graphics driver does when it begins: gives an output of the server at DISPLAY properties. Each call
/// must succeed, or the test fails.
class OutputProperties {
  public:
    explicit OutputProperties(const std::string& output) {
        REQUIRE_FALSE(xcb_connection_has_error(link_.get()));
        owned(
            xcb_randr_query_version_reply(link_.get(), xcb_randr_query_version(link_.get(), 1, 3), nullptr));
        const auto root = xcb_setup_roots_iterator(xcb_get_setup(link_.get())).data->root;
        const auto resources = owned(xcb_randr_get_screen_resources_reply(
            link_.get(), xcb_randr_get_screen_resources(link_.get(), root), nullptr));
        const auto* const outputs = xcb_randr_get_screen_resources_outputs(resources.get());
        for (int i = 0; i < xcb_randr_get_screen_resources_outputs_length(resources.get()); ++i) {
            const auto info = owned(xcb_randr_get_output_info_reply(
                link_.get(), xcb_randr_get_output_info(link_.get(), outputs[i], XCB_CURRENT_TIME), nullptr));
            if (std::string(reinterpret_cast<const char*>(xcb_randr_get_output_info_name(info.get())),
                            info->name_len) == output)
                output_ = outputs[i];
        }
        REQUIRE(output_ != 0);
    }
    void put_word(const std::string& name, const std::string& word) {
        const xcb_atom_t value = atom(word);
        put(name, XCB_ATOM_ATOM, 32, &value, 1);
    }
    void put_numbers(const std::string& name, const std::vector<std::int32_t>& numbers) {
        put(name, XCB_ATOM_INTEGER, 32, numbers.data(), numbers.size());
    }
    void put_bytes(const std::string& name, const std::vector<std::uint8_t>& bytes) {
        put(name, XCB_ATOM_INTEGER, 8, bytes.data(), bytes.size());
    }

  private:
    xcb_atom_t atom(const std::string& name) {
        return owned(
                   xcb_intern_atom_reply(
                       link_.get(),
                       xcb_intern_atom(link_.get(), 0, static_cast<std::uint16_t>(name.size()), name.data()),
                       nullptr))
            ->atom;
    }
    void put(const std::string& name, xcb_atom_t type, std::uint8_t bits, const void* data,
             std::size_t count) {
        const auto cookie = xcb_randr_change_output_property_checked(link_.get(), output_, atom(name), type,
                                                                     bits, XCB_PROP_MODE_REPLACE,
                                                                     static_cast<std::uint32_t>(count), data);
        const auto error = owned(xcb_request_check(link_.get(), cookie));
        REQUIRE_FALSE(error);
    }

    XcbLink link_ = link_to(nullptr);
    xcb_randr_output_t output_ = 0;
};

} // namespace overt::test
