/* Links against an installed carvel: the header's version is the library's,
   which is printed. */
#include <carvel.h>
#include <stdio.h>
#include <string.h>

#define TEXT_OF(x) #x
#define TEXT(x) TEXT_OF(x)
#define HEADER_VERSION \
    TEXT(CARVEL_VERSION_MAJOR) "." TEXT(CARVEL_VERSION_MINOR) "." TEXT(CARVEL_VERSION_PATCH)

int main(void) {
    printf("%s\n", carvel_version());
    return strcmp(carvel_version(), HEADER_VERSION) != 0;
}
