# Debian 12 packages (the list with apt names is in packages.txt). Those without a usable CMake config come through pkg-config;
# OpenImageIO has one, but it names an include folder that its package does not bring.
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(ZLIB REQUIRED)
find_package(glm REQUIRED)
find_package(fmt REQUIRED)
find_package(glfw3 REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(meshoptimizer REQUIRED)
find_package(draco REQUIRED)
find_package(embree 3 REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE) # sparse Cholesky; headers only, of which we use those under MPL 2
pkg_check_modules(OSMESA REQUIRED osmesa) # its header: the library is loaded by the first context that needs it
pkg_check_modules(EGL REQUIRED IMPORTED_TARGET egl)
pkg_check_modules(OIIO REQUIRED IMPORTED_TARGET OpenImageIO)
pkg_check_modules(EXR REQUIRED IMPORTED_TARGET OpenEXR) # the frames and maps that overt itself makes
pkg_check_modules(PNG REQUIRED IMPORTED_TARGET libpng) # the pictures for people that overt itself makes
pkg_check_modules(X11 REQUIRED IMPORTED_TARGET x11 xcb xcb-present xcb-randr xcb-screensaver)
pkg_check_modules(GIO REQUIRED IMPORTED_TARGET gio-2.0) # the session's D-Bus
pkg_check_modules(DRM REQUIRED IMPORTED_TARGET libdrm)
pkg_check_modules(PANGO REQUIRED IMPORTED_TARGET pangocairo fontconfig)
pkg_check_modules(CRYPTO REQUIRED IMPORTED_TARGET libcrypto)
pkg_check_modules(SQLITE REQUIRED IMPORTED_TARGET sqlite3)
pkg_check_modules(PORTAUDIO REQUIRED IMPORTED_TARGET portaudio-2.0)
# Their -pthread would be a flag that the precompiled headers were not compiled with.
set_property(TARGET PkgConfig::EXR PkgConfig::PANGO PkgConfig::GIO PkgConfig::PORTAUDIO PROPERTY INTERFACE_COMPILE_OPTIONS "")
pkg_check_modules(SNDFILE REQUIRED IMPORTED_TARGET sndfile)
pkg_check_modules(ZMQ REQUIRED IMPORTED_TARGET libzmq) # the language of Pupil Capture
pkg_check_modules(HIDAPI REQUIRED IMPORTED_TARGET hidapi-hidraw) # eye trackers and button boxes without a driver of the kernel's
pkg_check_modules(LIBUSB REQUIRED IMPORTED_TARGET libusb-1.0) # serial chips without a driver of the kernel's
find_package(SQLiteCpp REQUIRED)
# Draws the maps in report.html; r111, with its licence in the page.
find_file(OVERT_THREE_JS three.min.js PATHS /usr/share/javascript/three REQUIRED)
pkg_check_modules(IMGUI REQUIRED IMPORTED_TARGET imgui) # the window of the operator's view
