# Third-party packages, found once for the whole tree. Every one comes from Debian (scripts/install-packages).

find_package(asmjit REQUIRED)
find_package(Boost 1.74 REQUIRED)
find_package(CLI11 REQUIRED)
find_package(fastcdr REQUIRED)
find_package(fastrtps REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(OpenSSL REQUIRED)
find_package(SUNDIALS REQUIRED COMPONENTS cvode nvecserial sunnonlinsolfixedpoint)
find_package(Threads REQUIRED)
find_package(pugixml REQUIRED)
find_package(benchmark REQUIRED)
