#include "experiment/protocol/keys/key_rows.h"

namespace overt::key_rows {

std::vector<Key> button_box() {
    using B = ButtonBoxSettings;
    return {
        {"id", &B::id, identifier().required(), "By which the record names it."},
        {"kind", &B::kind, explanation_of_kinds<ButtonBoxKind>()},
        {"address", &B::address, left_out("the first of its kind"),
         "Of `xid`, the serial port, such as /dev/ttyUSB0, or usb:0403:f1c0 for a chip that has none. Of "
         "`iolab`, `hid`, `dial` and `spacemouse`, /dev/hidrawN, or vendor:product as lsusb shows them; "
         "`hid` "
         "and `dial` need it."},
        {"used_by", &B::used_by, "In whose hand it lies."},
        {"buttons", &B::buttons, left_out("all of the observer's go on"),
         "The name of a button and what it means, such as `[\"1 answer gold\", \"2 answer imitation\"]`. Of "
         "the observer: next, back, yes, no (of consent), and `answer` with the answer's words, which goes "
         "on as next does. Of the operator: pause, recalibrate, repeat, reject, skip, abort, yes, no, and "
         "the digits 1 to 9, which choose a reason."},
        {"required", &B::required,
         "Whether a session needs it. `false`: where it is not found, a session goes on without it, which is "
         "said and recorded."},
        {"steps_per_count", &B::steps_per_count, range(-1000, 1000),
         "Of `dial`: steps for each count that it tells. A step is a level of a match, or a pose of an "
         "object "
         "that is turned, which goes round with the knob; less than 0: the other way round."},
        {"full_turn_steps_s", &B::full_turn_steps_s, range(-1000, 1000),
         "Of `spacemouse`: steps in a second when it is twisted as far as it goes; less than 0: the other "
         "way "
         "round; 0: it does not turn."},
        {"full_tilt_steps_s", &B::full_tilt_steps_s, range(-1000, 1000),
         "Of `spacemouse`: the same of its pitch, which goes through elevations, or the second column of a "
         "match."},
        {"dead_zone", &B::dead_zone, range(0, 0.9), "Of `spacemouse`: share of its way that is none yet."},
    };
}

std::vector<Key> marker_output() {
    using M = MarkerOutputSettings;
    return {
        {"id", &M::id, identifier().required(), "By which the record names it."},
        {"kind", &M::kind, explanation_of_kinds<MarkerOutputKind>()},
        {"address", &M::address, left_out("/dev/parport0 of `parallel`; the first of `xid`"),
         "Of `serial`, `xid` and `parallel`, the port, such as /dev/ttyUSB1; of `serial` and `xid` also "
         "usb:0403:6001 for a chip that has none."},
        {"baud", &M::baud, range(1200, 921600),
         "Of `serial`, the speed, with 8 data bits, no parity and 1 stop bit."},
        {"as_text", &M::as_text,
         "Of `serial`, for devices that take lines of text: each code in figures, or without `codes` the "
         "text of "
         "every event, and a line feed after it. Nothing is taken back."},
        {"pulse_ms", &M::pulse_ms, range(0, 1000, "ms"),
         "For so long a code stays raised; 0: it is not taken back, for boxes that make their pulses by "
         "themselves. Of `t-lock` 24.8 ms at most."},
        {"codes", &M::codes, left_out("none: texts alone, of `lsl`"),
         "An event and its code, 1 to 255, of `t-lock` 1 to 1023, such as `[\"onset 10\", \"response 2\"]`. "
         "Events: trial (its begin), onset (first refresh of the animation), frame (each further frame), end "
         "(last refresh over), response (the answer), result (the trial is over). Those left out have none. "
         "Of `t-lock`: onset and frame."},
        {"condition_codes", &M::condition_codes, left_out("none"),
         "What the onset's code is raised by in trials of a task, an object or a material, such as "
         "`[\"task material 100\", \"object runner 20\"]`."},
        {"refresh_codes", &M::refresh_codes, left_out("none"),
         "Of `t-lock`, a refresh of the animation, from 0, and its code, such as `[\"120 4\"]`."},
        {"offset_ms", &M::offset_ms, range(0, 1000, "ms").left_out("one refresh"),
         "Of `t-lock`, from the vertical blank of the refresh that is marked to the edge of the outputs, as "
         "an oscilloscope shows it. A box acts on a row of the picture at the refresh after it, by the "
         "vendor's own software (psychopy-crs); that default was not measured here. The record's not_after_s "
         "of a code has it added."},
        {"required", &M::required,
         "Whether a session needs it. `false`: where it cannot be opened, a session goes on without it, "
         "which is said and recorded."},
    };
}

} // namespace overt::key_rows
