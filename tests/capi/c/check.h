/* Checks that print where they failed, and count. */
#ifndef CHECK_H
#define CHECK_H

#include <carvel.h>
#include <stddef.h>

/* What the last call that was given it came to. Made by check_begin. */
extern carvel_error *failure;

/* Makes `failure`. */
void check_begin(void);
/* Destroys it; the exit code of the program: 1 if a check failed. */
int check_end(void);

/* Told about the checks that follow, printed when one fails. */
void check_context(const char *text);

int check_true(int ok, const char *what, const char *file, int line);
int check_uint(uint64_t expected, uint64_t actual, const char *what, const char *file, int line);
int check_status(carvel_status expected, carvel_status actual, const char *what,
                 const char *file, int line);
int check_element(uint64_t entry, uint64_t element, uint64_t kind, uint64_t index,
                  uint64_t second, const char *file, int line);
int check_bytes(const void *expected, const void *actual, size_t size, const char *what,
                const char *file, int line);

/* Each is 1 if it holds. */
#define CHECK(condition) check_true((condition) ? 1 : 0, #condition, __FILE__, __LINE__)
#define CHECK_UINT(expected, actual) \
    check_uint((uint64_t)(expected), (uint64_t)(actual), #actual, __FILE__, __LINE__)
#define CHECK_STATUS(expected, call) check_status((expected), (call), #call, __FILE__, __LINE__)
#define CHECK_OK(call) CHECK_STATUS(CARVEL_STATUS_OK, call)
#define CHECK_BYTES(expected, actual, size) \
    check_bytes((expected), (actual), (size), #actual, __FILE__, __LINE__)
/* An element of an entry of `failure`. */
#define CHECK_ELEMENT(entry, element, kind, index, second) \
    check_element((entry), (element), (uint64_t)(kind), (uint64_t)(index), (uint64_t)(second), \
                  __FILE__, __LINE__)

/* Memory or the end of the program. Zeroed; never of size 0. */
void *take(size_t size);
/* The same for an array, with the product checked. */
void *take_array(uint64_t count, size_t size);

#define TAKE(type, count) ((type *)take_array((count), sizeof(type)))

/* A number from 0 to `limit` - 1, from a state that is any number. */
uint32_t random_below(uint64_t *state, uint32_t limit);
/* A number in [-1, 1). */
double random_double(uint64_t *state);

/* The number after a program's name, or the default: tests under slow tools
 * ask for less. */
unsigned long size_argument(int count, char **arguments, unsigned long otherwise);

#endif
