/// Which stream of the Lab Streaming Layer is meant, and finding it.
#pragma once

#include <string>
#include <string_view>

#include "devices/lsl/lsl_library.h"
#include "experiment/session_time.h"

namespace overt {

/// What a stream has to be; what is empty may be anything. Without any of it, one of gaze, by its type.
struct LslStreamChoice {
    std::string name, source_id, host, uid, type;
    bool is_open() const {
        return name.empty() && source_id.empty() && host.empty() && uid.empty() && type.empty();
    }
};

/// From what an experimenter writes: the stream's name, or what tells it, such as
/// "source_id=eyelink-lab2, host=lab2" (name, source_id, host, uid and type). Throws InputError for another
/// word before an equals sign.
LslStreamChoice parse_lsl_choice(std::string_view address);

/// Whether a stream's type is one that programs give streams of gaze: "Gaze", "gaze", "EyeTracking",
/// "Eyetracker", "ET".
bool is_lsl_type_of_gaze(std::string_view type);

/// The one that is meant. Looks for `patience` until one is there, and then long enough to see that it is the
/// only one: two seconds more, since liblsl misses one now and then; not for one that is told by its uid.
/// Throws DeviceError for none, and for several with a list of them and of what tells them apart. `library`
/// must outlive the result.
LslOwned<LslStreamInfo> find_lsl_stream(const LslLibrary& library, const LslStreamChoice& choice,
                                        SessionDuration patience);

} // namespace overt
