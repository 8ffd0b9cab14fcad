/// A ColorCAL MkII photometer by Cambridge Research Systems, over its USB serial line. A command ends with
/// LF, an answer "OK00,field,…" with LF CR and a prompt ">"; anything but OK00 at its head is an error.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "devices/link/byte_transport.h"
#include "devices/link/serial_port_search.h"
#include "experiment/ports/clock.h"

namespace overt {

/// USB product number, beside the vendor's (not re-read in a source, so a port can be named instead).
inline constexpr std::uint16_t colorcal_product_id = 0x1001;

/// What the photometer says of itself.
struct ColorCalIdentity {
    std::string port, firmware, serial_number;
    int build = 0; ///< of the firmware
};

struct ColorCalTimeouts {
    SessionDuration reply = std::chrono::milliseconds(500);
    SessionDuration measurement = std::chrono::seconds(5); ///< a dark patch takes long
    SessionDuration dark_calibration = std::chrono::seconds(5);
};

/// All functions throw DeviceError naming port, command and what came, if no answer comes in time, it is an
/// error or cannot be read. One thread.
class ColorCal {
  public:
    /// Asks who is there and for the three rows of its matrix. `clock` must outlive this.
    ColorCal(std::unique_ptr<ByteTransport> transport, Clock& clock, ColorCalTimeouts timeouts = {});

    const ColorCalIdentity& identity() const noexcept { return identity_; }

    /// From the sensors' readings to CIE 1931 XYZ.
    const glm::dmat3& xyz_from_raw() const noexcept { return xyz_from_raw_; }

    /// Firmware before build 877 forgets its dark level when it loses power: calibrate_dark() then.
    bool forgets_dark_level() const noexcept { return identity_.build < 877; }

    /// Measures the dark level. The lens must be covered.
    void calibrate_dark();

    /// Measures what is before the lens: CIE 1931 XYZ, Y in cd/m2. Takes up to 5 s.
    glm::dvec3 measure_xyz();

  private:
    std::vector<std::string> ask(std::string_view command, SessionDuration timeout);
    void send(std::string_view command);
    glm::dvec3 ask_matrix_row(int row);

    std::unique_ptr<ByteTransport> transport_;
    Clock& clock_;
    ColorCalTimeouts timeouts_;
    ColorCalIdentity identity_;
    glm::dmat3 xyz_from_raw_{1.0};
};

/// A number of the matrix as the photometer writes it: n / 10000 below 50000, else (50000 - n) / 10000.
/// Nothing for a text that is no integer from 0 to 99999.
std::optional<double> colorcal_matrix_entry(std::string_view text);

/// Takes the photometer on `port`, or else the one among the candidates whose USB numbers are a ColorCAL's
/// (0861:1001); no other is asked. Throws DeviceError if there is none or more than one.
std::unique_ptr<ColorCal> find_colorcal(std::span<const SerialPortInfo> candidates,
                                        const std::optional<std::string>& port, const TransportOpener& open,
                                        Clock& clock, ColorCalTimeouts timeouts = {});

} // namespace overt
