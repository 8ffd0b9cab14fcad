/// Connections to an X server, and its answers, freed at their end.
#pragma once

#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>

#include <xcb/randr.h>

namespace overt {

template <class T> using XcbReply = std::unique_ptr<T, decltype(&std::free)>;

/// Takes what an xcb_…_reply() function gave; may be null.
template <class T> XcbReply<T> owned(T* reply) { return {reply, &std::free}; }

using XcbLink = std::unique_ptr<xcb_connection_t, decltype(&xcb_disconnect)>;

/// A connection of its own. `server`: as DISPLAY names it, which is taken for null. What it gives may have an
/// error: xcb_connection_has_error().
inline XcbLink link_to(const char* server) { return {xcb_connect(server, nullptr), &xcb_disconnect}; }

/// Whether the server has an extension of this name.
inline bool has_extension(xcb_connection_t* link, std::string_view name) {
    const auto reply = owned(xcb_query_extension_reply(
        link, xcb_query_extension(link, static_cast<std::uint16_t>(name.size()), name.data()), nullptr));
    return reply && reply->present;
}

/// Whether the server has RandR, to be asked before anything of it: a server answers in the version that it
/// has been told, and with none as if it had none.
inline bool begin_randr(xcb_connection_t* link) {
    return xcb_connection_has_error(link) == 0 && has_extension(link, "RANDR") &&
           owned(xcb_randr_query_version_reply(link, xcb_randr_query_version(link, 1, 3), nullptr));
}

/// Such as "DP-1".
inline std::string name_of(const xcb_randr_get_output_info_reply_t& output) {
    return {reinterpret_cast<const char*>(xcb_randr_get_output_info_name(&output)), output.name_len};
}

} // namespace overt
