#include "experiment/keys/key_places.h"

#include "experiment/base/error.h"

namespace overt {

void KeyPlaces::note(std::string path, Place place) { places_.insert_or_assign(std::move(path), place); }

bool KeyPlaces::is_written(std::string_view path) const { return places_.contains(path); }

Place KeyPlaces::of(std::string_view path) const {
    while (true) {
        if (const auto known = places_.find(path); known != places_.end())
            return known->second;
        const std::size_t last_step = path.find_last_of(".[");
        if (last_step == std::string_view::npos)
            return {1, 1};
        path = path.substr(0, last_step);
    }
}

Place KeyPlaces::first_written(std::initializer_list<std::string_view> paths) const {
    OVERT_EXPECTS(paths.size() > 0);
    for (const std::string_view path : paths) {
        if (is_written(path))
            return of(path);
    }
    return of(*paths.begin());
}

} // namespace overt
