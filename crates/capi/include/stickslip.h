/*
 * stickslip.h: C interface of stickslip, a simulator of stick-slip drives. C99 and C++.
 *
 * A simulation is created from the text of a scenario file, which may not name other files. It belongs to one thread at a time; different
 * simulations may run in different threads. The library opens no files, starts no threads and prints nothing. All quantities are in SI
 * units.
 *
 * Functions that return an int return 0, or 1 for an error, whose text is that of stickslip_error(), or 2 for a fault of the library.
 * After an error the simulation is as before the call, but for an error of the run, after which it is at the time reached.
 */
#ifndef STICKSLIP_H
#define STICKSLIP_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A simulation. */
typedef struct stickslip stickslip;

enum { STICKSLIP_OUTPUT = 0, STICKSLIP_INPUT = 1, STICKSLIP_PARAMETER = 2 };

/* What a variable is. The texts live as long as the simulation. */
typedef struct stickslip_description {
    const char *name;        /* such as slider.x; parts that are not identifiers are in single quotes */
    const char *unit;        /* SI unit; empty for plain numbers */
    const char *description;
    int role;                /* output, input or parameter; the scenario's section `interface` chooses them */
    uint32_t reference;      /* number for stickslip_get and stickslip_set */
} stickslip_description;

/* Version of the library, such as 0.1.0. */
const char *stickslip_version(void);

/* Text of the last error in this thread. It is valid until the next error. */
const char *stickslip_error(void);

/* Creates a simulation from a scenario of `length` bytes of UTF-8. */
int stickslip_create(const char *json, size_t length, stickslip **simulation);

/* Frees a simulation; NULL is allowed. */
void stickslip_free(stickslip *simulation);

/* Number of variables. */
size_t stickslip_variables(const stickslip *simulation);

/* Describes variable `index`, from 0. */
int stickslip_variable(stickslip *simulation, size_t index, stickslip_description *variable);

/* Finds the reference of a variable by its name. */
int stickslip_find(stickslip *simulation, const char *name, uint32_t *reference);

/* Reads a variable. A contact state is 0 open, 1 stick, 2 partial slip, 3 gross slip. Reference 0 is the time, s. */
int stickslip_get(stickslip *simulation, uint32_t reference, double *value);

/* Sets an input, or before the start a parameter. A held input and a command act from the present time on; an input of kind `linear`
   reaches the value at the end of the next advance. */
int stickslip_set(stickslip *simulation, uint32_t reference, double value);

/* Starts with the parameters and inputs set so far. stickslip_advance does so, too. */
int stickslip_start(stickslip *simulation);

/* Ends the run; parameters and inputs have their initial values again. */
int stickslip_reset(stickslip *simulation);

/* Advances to an absolute time, s, not before the present one. */
int stickslip_advance(stickslip *simulation, double until);

/* Simulated time, s. */
double stickslip_time(const stickslip *simulation);

/* Number of columns of trace.csv. */
size_t stickslip_columns(const stickslip *simulation);

/* Reads all columns of trace.csv; `count` is their number. */
int stickslip_row(stickslip *simulation, double *values, size_t count);

/* Number of bytes of the present state. */
size_t stickslip_state_size(const stickslip *simulation);

/* Writes the present state; `size` is that of stickslip_state_size. */
int stickslip_save(stickslip *simulation, uint8_t *bytes, size_t size);

/* Continues from a state, also one of another process with the same scenario; the results have the same bits. */
int stickslip_restore(stickslip *simulation, const uint8_t *bytes, size_t size);

#ifdef __cplusplus
}
#endif

#endif
