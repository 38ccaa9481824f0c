/* Three Rust static libraries in one program, each with its own standard library. */
#include <carvel.h>
#include <stdio.h>

int one_panics(int number);
int two_panics(int number);

int main(void) {
    printf("%s %d %d\n", carvel_version(), one_panics(1), two_panics(1));
    return 0;
}
