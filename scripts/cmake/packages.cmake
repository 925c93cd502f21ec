# Third-party packages, found once for the whole tree. Every one comes from Debian (scripts/install-packages).

find_package(asmjit REQUIRED)
find_package(assimp 5.2 REQUIRED)
find_package(box2d REQUIRED)
find_package(Boost 1.74 REQUIRED)
find_package(CLI11 REQUIRED)
find_package(CURL 7.85 REQUIRED)
find_package(Eigen3 3.4 REQUIRED)
find_package(fastcdr REQUIRED)
find_package(fastrtps REQUIRED)
find_package(fcl 0.7 REQUIRED)
find_package(fmt REQUIRED)
find_package(hwy 1.0 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(OpenSSL 3.0 REQUIRED)
find_package(SUNDIALS REQUIRED COMPONENTS cvode kinsol nvecserial sunnonlinsolfixedpoint sunnonlinsolnewton sunlinsoldense sunlinsolklu sunlinsolspgmr sunmatrixdense sunmatrixsparse)
find_package(Threads REQUIRED)
find_package(PNG REQUIRED)
find_package(pugixml REQUIRED)
find_package(benchmark REQUIRED)
find_package(spdlog REQUIRED)
find_package(SQLite3 REQUIRED)
find_package(yaml-cpp REQUIRED)

# libsodium brings no CMake configuration. It hashes in the scan process, whose memory is locked: libcrypto would be 4 MB there.
find_library(STEPWRIGHT_SODIUM sodium REQUIRED)
add_library(sodium::sodium UNKNOWN IMPORTED)
set_target_properties(sodium::sodium PROPERTIES IMPORTED_LOCATION ${STEPWRIGHT_SODIUM})

# libmodbus brings pkg-config only.
find_library(STEPWRIGHT_MODBUS modbus REQUIRED)
add_library(modbus::modbus UNKNOWN IMPORTED)
set_target_properties(modbus::modbus PROPERTIES IMPORTED_LOCATION ${STEPWRIGHT_MODBUS})

# minizip of zlib brings pkg-config only.
find_path(STEPWRIGHT_MINIZIP_INCLUDE minizip/unzip.h REQUIRED)
find_library(STEPWRIGHT_MINIZIP minizip REQUIRED)
add_library(minizip::minizip UNKNOWN IMPORTED)
set_target_properties(minizip::minizip PROPERTIES IMPORTED_LOCATION ${STEPWRIGHT_MINIZIP} INTERFACE_INCLUDE_DIRECTORIES ${STEPWRIGHT_MINIZIP_INCLUDE})

# Clp brings pkg-config only. Licence of Clp and CoinUtils as Debian packages them: EPL-1.0; linked as they are, never changed.
find_path(STEPWRIGHT_COIN_INCLUDE ClpSimplex.hpp PATH_SUFFIXES coin REQUIRED)
find_library(STEPWRIGHT_COIN_UTILS CoinUtils REQUIRED)
find_library(STEPWRIGHT_CLP Clp REQUIRED)
add_library(coin::clp UNKNOWN IMPORTED)
set_target_properties(coin::clp PROPERTIES IMPORTED_LOCATION ${STEPWRIGHT_CLP} INTERFACE_INCLUDE_DIRECTORIES ${STEPWRIGHT_COIN_INCLUDE}
                                           INTERFACE_LINK_LIBRARIES ${STEPWRIGHT_COIN_UTILS})

# libmosquitto brings pkg-config only. Licence: EPL-2.0 or EDL-1.0 (BSD); linked as it is.
find_library(STEPWRIGHT_MOSQUITTO mosquitto REQUIRED)
add_library(mosquitto::mosquitto UNKNOWN IMPORTED)
set_target_properties(mosquitto::mosquitto PROPERTIES IMPORTED_LOCATION ${STEPWRIGHT_MOSQUITTO})

# The C interface of GEOS brings pkg-config only. Licence: LGPL-2.1; linked as a shared library, as it is.
find_path(STEPWRIGHT_GEOS_INCLUDE geos_c.h REQUIRED)
find_library(STEPWRIGHT_GEOS geos_c REQUIRED)
add_library(geos::geos_c UNKNOWN IMPORTED)
set_target_properties(geos::geos_c PROPERTIES IMPORTED_LOCATION ${STEPWRIGHT_GEOS} INTERFACE_INCLUDE_DIRECTORIES ${STEPWRIGHT_GEOS_INCLUDE})

# OMPL's configuration names files and folders, no target. Licence: BSD-3-Clause.
find_package(ompl 1.5 REQUIRED)
add_library(ompl::ompl INTERFACE IMPORTED)
target_include_directories(ompl::ompl SYSTEM INTERFACE ${OMPL_INCLUDE_DIRS} ${EIGEN3_INCLUDE_DIRS})
target_link_libraries(ompl::ompl INTERFACE ${OMPL_LIBRARIES})
