#include "experiment/protocol/key_rows.h"

namespace overt::key_rows {

Section button_box() {
    using B = ButtonBoxSettings;
    return {
        .name = "button_box",
        .explanation =
            "Response boxes, in sessions in real time; see [devices.md](devices.md). All presses are in the "
            "record with their uncertainty, and the time of an answer is that of the press. What one "
            "person's "
            "box says never counts as the other's.",
        .keys =
            {
                {{.name = "id",
                  .is_required = true,
                  .is_identifier = true,
                  .explanation = "By which the record names it."},
                 &B::id},
                {{.name = "kind",
                  .explanation =
                      "`iolab`: the ioLab box. `xid`: boxes of Cedrus that speak XID. `hid`: game pads, "
                      "joysticks and boxes that present themselves as keyboards. `cb6`: the infrared "
                      "box and the digital inputs of the Display++ or Bits# of `[display]`."},
                 &B::kind},
                {{.name = "address",
                  .if_left_out = "the first of its kind",
                  .explanation = "Of `xid`, the serial port, such as /dev/ttyUSB0, or usb:0403:f1c0 for a "
                                 "chip that has none. Of `iolab` and `hid`, "
                                 "/dev/hidrawN, or vendor:product as lsusb shows them; `hid` needs it."},
                 &B::address},
                {{.name = "used_by", .explanation = "In whose hand it lies."}, &B::used_by},
                {{.name = "buttons",
                  .if_left_out = "all of the observer's go on",
                  .explanation =
                      "The name of a button and what it means, such as `[\"1 answer gold\", \"2 answer "
                      "imitation\"]`. Of the observer: next, back, yes, no (of consent), and `answer` with "
                      "the "
                      "answer's words, which goes on as next does. Of the operator: pause, recalibrate, "
                      "repeat, "
                      "reject, skip, abort, yes, no, and the digits 1 to 9, which choose a reason."},
                 &B::buttons},
                {{.name = "required",
                  .explanation =
                      "Whether a session needs it. `false`: where it is not found, a session goes on "
                      "without it, which is said and recorded."},
                 &B::required},
            },
        .home = &Protocol::button_boxes};
}

Section marker_output() {
    using M = MarkerOutputSettings;
    return {
        .name = "marker_output",
        .explanation = "Where other devices are told of a session's events as they happen, in sessions in "
                       "real time; see "
                       "[devices.md](devices.md). When each marker was sent is in the record.",
        .keys =
            {
                {{.name = "id",
                  .is_required = true,
                  .is_identifier = true,
                  .explanation = "By which the record names it."},
                 &M::id},
                {{.name = "kind",
                  .explanation =
                      "`serial`: a byte to a serial port. `parallel`: a byte on the data lines of a "
                      "parallel port. `lsl`: a text in the stream `overt` of the Lab Streaming Layer. "
                      "`t-lock`: the digital outputs of the Display++ or Bits#, raised by the picture "
                      "itself at the refresh that it marks."},
                 &M::kind},
                {{.name = "address",
                  .if_left_out = "/dev/parport0 of `parallel`",
                  .explanation = "Of `serial` and `parallel`, the port, such as /dev/ttyUSB1; of `serial` "
                                 "also usb:0403:6001 for a chip that has none."},
                 &M::address},
                {{.name = "baud",
                  .low = 1200,
                  .high = 921600,
                  .explanation = "Of `serial`, the speed, with 8 data bits, no parity and 1 stop bit."},
                 &M::baud},
                {{.name = "pulse_ms",
                  .unit = "ms",
                  .low = 0,
                  .high = 1000,
                  .explanation =
                      "For so long a code stays raised; 0: it is not taken back, for boxes that make "
                      "their pulses by themselves. Of `t-lock` 24.8 ms at most."},
                 &M::pulse_ms},
                {{.name = "library",
                  .if_left_out = "where the system looks",
                  .explanation = "Of `lsl`, the library liblsl, a file."},
                 &M::library},
                {{.name = "codes",
                  .if_left_out = "none: texts alone, of `lsl`",
                  .explanation =
                      "An event and its code, 1 to 255, of `t-lock` 1 to 1023, such as `[\"onset 10\", "
                      "\"response 2\"]`. Events: trial (its begin), onset (first refresh of the animation), "
                      "frame "
                      "(each further frame), end (last refresh over), response (the answer), result (the "
                      "trial is "
                      "over). Those left out have none. Of `t-lock`: onset and frame."},
                 &M::codes},
                {{.name = "condition_codes",
                  .if_left_out = "none",
                  .explanation = "What the onset's code is raised by in trials of a task, a sculpture or a "
                                 "material, such as `[\"task material 100\", \"sculpture runner 20\"]`."},
                 &M::condition_codes},
                {{.name = "refresh_codes",
                  .if_left_out = "none",
                  .explanation = "Of `t-lock`, a refresh of the animation, from 0, and its code, such as "
                                 "`[\"120 4\"]`."},
                 &M::refresh_codes},
                {{.name = "offset_ms",
                  .unit = "ms",
                  .low = 0,
                  .high = 1000,
                  .if_left_out = "one refresh",
                  .explanation =
                      "Of `t-lock`, from the vertical blank of the refresh that is marked to the edge of the "
                      "outputs, as an oscilloscope shows it. A box acts on a row of the picture at the "
                      "refresh after it, by the vendor's own software (psychopy-crs); that default was not "
                      "measured here. The record's not_after_s of a code has it added."},
                 &M::offset_ms},
                {{.name = "required",
                  .explanation =
                      "Whether a session needs it. `false`: where it cannot be opened, a session goes "
                      "on without it, which is said and recorded."},
                 &M::required},
            },
        .home = &Protocol::marker_outputs};
}

} // namespace overt::key_rows
