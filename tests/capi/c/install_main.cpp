// The same as install_main.c for C++, through the C++ header.
#include <carvel.hpp>
#include <cstdio>

int main() {
    std::printf("%s\n", carvel_version());
    return 0;
}
