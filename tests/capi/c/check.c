#include "check.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

carvel_error *failure = NULL;

static unsigned long failures = 0;
static const char *context = "";

/* More would hide the first. */
enum { SHOWN = 40 };

void check_begin(void)
{
    if (carvel_error_create(&failure) != CARVEL_STATUS_OK) {
        fprintf(stderr, "no error object can be made\n");
        exit(1);
    }
}

int check_end(void)
{
    carvel_error_destroy(failure);
    failure = NULL;
    if (failures > 0)
        fprintf(stderr, "%lu checks failed\n", failures);
    return failures == 0 ? 0 : 1;
}

void check_context(const char *text)
{
    context = text;
}

/* Starts the line of a failed check; 0 if there were too many already. */
static int begin_failure(const char *file, int line)
{
    failures++;
    if (failures > SHOWN)
        return 0;
    fprintf(stderr, "%s:%d: ", file, line);
    if (context[0] != '\0')
        fprintf(stderr, "[%s] ", context);
    return 1;
}

int check_true(int ok, const char *what, const char *file, int line)
{
    if (!ok && begin_failure(file, line))
        fprintf(stderr, "%s does not hold\n", what);
    return ok;
}

int check_uint(uint64_t expected, uint64_t actual, const char *what, const char *file, int line)
{
    if (expected != actual && begin_failure(file, line))
        fprintf(stderr, "%s is %lu, expected %lu\n", what, (unsigned long)actual,
                (unsigned long)expected);
    return expected == actual;
}

int check_status(carvel_status expected, carvel_status actual, const char *what,
                 const char *file, int line)
{
    if (expected != actual && begin_failure(file, line))
        fprintf(stderr, "%s is %ld (%s), expected %ld (%s); the error says \"%s\"\n", what,
                (long)actual, carvel_status_string(actual), (long)expected,
                carvel_status_string(expected), carvel_error_message(failure));
    return expected == actual;
}

int check_element(uint64_t entry, uint64_t element, uint64_t kind, uint64_t index,
                  uint64_t second, const char *file, int line)
{
    carvel_element found = carvel_error_element(failure, entry, element);
    int ok = found.kind == kind && found.index == index && found.second == second;
    if (!ok && begin_failure(file, line))
        fprintf(stderr, "element %lu of entry %lu is %lu: %lu %lu, expected %lu: %lu %lu\n",
                (unsigned long)element, (unsigned long)entry, (unsigned long)found.kind,
                (unsigned long)found.index, (unsigned long)found.second, (unsigned long)kind,
                (unsigned long)index, (unsigned long)second);
    return ok;
}

int check_bytes(const void *expected, const void *actual, size_t size, const char *what,
                const char *file, int line)
{
    const unsigned char *x = (const unsigned char *)expected;
    const unsigned char *y = (const unsigned char *)actual;
    size_t i = 0;
    while (i < size && x[i] == y[i])
        i++;
    if (i < size && begin_failure(file, line))
        fprintf(stderr, "%s differs at byte %lu of %lu: %02x, expected %02x\n", what,
                (unsigned long)i, (unsigned long)size, (unsigned)y[i], (unsigned)x[i]);
    return i == size;
}

void *take(size_t size)
{
    void *memory = calloc(size > 0 ? size : 1, 1);
    if (memory == NULL) {
        fprintf(stderr, "the test itself has no memory left\n");
        exit(1);
    }
    return memory;
}

void *take_array(uint64_t count, size_t size)
{
    if (count > (uint64_t)1 << 40) {
        fprintf(stderr, "an array of %lu is no test's wish\n", (unsigned long)count);
        exit(1);
    }
    return take((size_t)count * size);
}

/* Splitmix64. */
static uint64_t next_random(uint64_t *state)
{
    uint64_t z;
    *state += (uint64_t)0x9e3779b97f4a7c15UL;
    z = *state;
    z = (z ^ (z >> 30)) * (uint64_t)0xbf58476d1ce4e5b9UL;
    z = (z ^ (z >> 27)) * (uint64_t)0x94d049bb133111ebUL;
    return z ^ (z >> 31);
}

uint32_t random_below(uint64_t *state, uint32_t limit)
{
    return (uint32_t)((next_random(state) >> 32) % limit);
}

double random_double(uint64_t *state)
{
    return (double)(next_random(state) >> 11) / 4503599627370496.0 - 1.0;
}

unsigned long size_argument(int count, char **arguments, unsigned long otherwise)
{
    return count > 1 ? strtoul(arguments[1], NULL, 10) : otherwise;
}
