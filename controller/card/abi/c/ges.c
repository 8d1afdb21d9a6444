/* The part of libges that is the same for all functions of the card: Python is started in the program's process, and
   each call goes to the Python function of its number. What this file has of its own, drycut puts above it: where Python
   and its packages are. The functions of the card stand below it, a line each, made of their table.

   A call that cannot be made answers -1, and what it was to fill is 0: never 0 = done with what stood there before. */
#define PY_SSIZE_T_CLEAN
#include <Python.h>

#include <dlfcn.h>
#include <pthread.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "ges.h"

#define DRYCUT __attribute__((visibility("default")))
#define FAILED (-1)
#define MOST 16 /* parameters of a function */

enum { SLEEP, MILLISECONDS, END, OTHERS }; /* behind the functions of the card */

static pthread_mutex_t starting = PTHREAD_MUTEX_INITIALIZER;
static atomic_int state; /* 0 not yet started, 1 started, -1 cannot be used */
static atomic_ullong passed[2]; /* threads that came into the library, and that left it */
static _Thread_local int inside;
static PyObject *functions; /* a tuple: those of the card by number, then the others */
static Py_ssize_t card_functions;

struct arguments {
    va_list left;
};

/* What a thread has to put back when it leaves the library. */
struct visit {
    sigset_t signals;
    int cancels;
    PyGILState_STATE gil;
};

/* No signal and no cancelling comes between while a thread is in Python. */
static void shield(struct visit *visit)
{
    sigset_t all;
    sigfillset(&all);
    sigdelset(&all, SIGSEGV), sigdelset(&all, SIGBUS), sigdelset(&all, SIGFPE), sigdelset(&all, SIGILL);
    sigdelset(&all, SIGABRT), sigdelset(&all, SIGTRAP), sigdelset(&all, SIGPROF);
    pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, &visit->cancels);
    pthread_sigmask(SIG_BLOCK, &all, &visit->signals);
    inside++;
}

static void unshield(struct visit *visit)
{
    inside--;
    pthread_sigmask(SIG_SETMASK, &visit->signals, NULL);
    pthread_setcancelstate(visit->cancels, NULL);
}

static void say_why(const char *what)
{
    PyObject *type = NULL, *value = NULL, *trace = NULL, *text = NULL;
    const char *words = NULL;
    PyErr_Fetch(&type, &value, &trace);
    if (value)
        text = PyObject_Str(value);
    if (text)
        words = PyUnicode_AsUTF8(text);
    fprintf(stderr, "drycut: error: %s: %s\n", what, words && *words ? words : "Python failed");
    PyErr_Clear();
    Py_XDECREF(type), Py_XDECREF(value), Py_XDECREF(trace), Py_XDECREF(text);
}

/* A Python of our own, blind to the program's environment, locale, signals and streams. */
static int begin_python(void)
{
    PyPreConfig before;
    PyConfig config;
    PyStatus status;
    if (Py_IsInitialized())
        return 1;
    PyPreConfig_InitIsolatedConfig(&before);
    before.utf8_mode = 1;
    status = Py_PreInitialize(&before);
    PyConfig_InitIsolatedConfig(&config);
    config.site_import = 0;
    config.pathconfig_warnings = 0;
    config.module_search_paths_set = 1;
    if (!PyStatus_Exception(status))
        status = PyConfig_SetBytesString(&config, &config.executable, drycut_python);
    for (int i = 0; drycut_paths[i] && !PyStatus_Exception(status); i++) {
        wchar_t *path = Py_DecodeLocale(drycut_paths[i], NULL);
        status = path ? PyWideStringList_Append(&config.module_search_paths, path) : PyStatus_NoMemory();
        PyMem_RawFree(path);
    }
    if (!PyStatus_Exception(status))
        status = Py_InitializeFromConfig(&config);
    PyConfig_Clear(&config);
    if (PyStatus_Exception(status)) {
        fprintf(stderr, "drycut: error: libges cannot start Python: %s\n", status.err_msg ? status.err_msg : "");
        return 0;
    }
    PyEval_SaveThread();
    return 1;
}

/* In a program that is written in Python itself, the packages may be unknown. */
static void know_paths(void)
{
    PyObject *known = PySys_GetObject("path");
    for (int i = 0; known && drycut_paths[i]; i++) {
        PyObject *path = PyUnicode_DecodeFSDefault(drycut_paths[i]);
        if (path && !PySequence_Contains(known, path))
            PyList_Append(known, path);
        Py_XDECREF(path);
    }
    PyErr_Clear();
}

static int begin_card(void)
{
    PyObject *module, *threads;
    know_paths();
    module = PyImport_ImportModule("controller.card.abi.start");
    threads = PyMemoryView_FromMemory((char *)passed, sizeof passed, PyBUF_READ);
    if (module && threads)
        functions = PyObject_CallMethod(module, "start", "sO", drycut_digest, threads);
    if (!functions || !PyTuple_Check(functions))
        say_why("libges cannot start");
    Py_XDECREF(module), Py_XDECREF(threads);
    if (!functions || !PyTuple_Check(functions))
        return 0;
    card_functions = PyTuple_GET_SIZE(functions) - OTHERS;
    return 1;
}

static PyObject *called(Py_ssize_t index, PyObject *const *given, size_t count)
{
    return PyObject_Vectorcall(PyTuple_GET_ITEM(functions, index), given, count, NULL);
}

/* When all of the program is over, its static objects too. */
__attribute__((destructor)) static void end(void)
{
    struct visit visit;
    if (atomic_load(&state) != 1 || inside)
        return;
    shield(&visit);
    atomic_fetch_add(&passed[0], 1);
    visit.gil = PyGILState_Ensure();
    Py_XDECREF(called(card_functions + END, NULL, 0));
    PyErr_Clear();
    PyGILState_Release(visit.gil);
    atomic_fetch_add(&passed[1], 1);
    unshield(&visit);
}

/* The child of a fork has the threads of its parent no more, and not its card. */
static void forked(void)
{
    atomic_store(&state, FAILED);
}

static int begin(void)
{
    struct visit visit;
    int begun;
    dlopen(drycut_libpython, RTLD_NOW | RTLD_GLOBAL | RTLD_NOLOAD); /* for modules of Python in C */
    if (!begin_python())
        return 0;
    visit.gil = PyGILState_Ensure();
    begun = begin_card();
    PyGILState_Release(visit.gil);
    return begun && !pthread_atfork(NULL, NULL, forked);
}

static int started(void)
{
    int known = atomic_load(&state);
    if (known)
        return known == 1;
    pthread_mutex_lock(&starting);
    if (!atomic_load(&state))
        atomic_store(&state, begin() ? 1 : FAILED);
    known = atomic_load(&state);
    pthread_mutex_unlock(&starting);
    return known == 1;
}

/* Into Python, where it can be had; threads are counted before they wait for it. */
static int enter(struct visit *visit)
{
    shield(visit);
    atomic_fetch_add(&passed[0], 1);
    if (started()) {
        visit->gil = PyGILState_Ensure();
        return 1;
    }
    atomic_fetch_add(&passed[1], 1);
    unshield(visit);
    return 0;
}

static void leave(struct visit *visit)
{
    PyGILState_Release(visit->gil);
    atomic_fetch_add(&passed[1], 1);
    unshield(visit);
}

static PyObject *block(const TLookData *of)
{
    if (!of)
        return Py_NewRef(Py_None);
    return Py_BuildValue("(iidddddddhlh)", of->Code, of->PlaneGroup, of->r, of->x, of->y, of->z, of->F, of->cx, of->cy,
                         of->i, of->n, of->flag);
}

/* The next argument as Python has it. */
static PyObject *taken(char letter, struct arguments *given)
{
    const char *text;
    switch (letter) {
    case 'd':
        return PyFloat_FromDouble(va_arg(given->left, double));
    case 'l':
        return PyLong_FromLong(va_arg(given->left, long));
    case 'L':
        return PyLong_FromUnsignedLong(va_arg(given->left, unsigned long));
    case 's':
        text = va_arg(given->left, const char *);
        return text ? PyUnicode_DecodeUTF8(text, (Py_ssize_t)strlen(text), "backslashreplace") : Py_NewRef(Py_None);
    case 'B':
        return block(va_arg(given->left, const TLookData *));
    case 'K':
        return PyLong_FromVoidPtr(va_arg(given->left, void *));
    default:
        return PyLong_FromLong(va_arg(given->left, int));
    }
}

/* Goes by the next argument where there is no Python for it. */
static void skip(char letter, struct arguments *given)
{
    if (letter == 'd')
        (void)va_arg(given->left, double);
    else if (strchr("lL", letter))
        (void)va_arg(given->left, long);
    else if (strchr("sBK", letter))
        (void)va_arg(given->left, void *);
    else
        (void)va_arg(given->left, int);
}

static double number(PyObject *value)
{
    return value ? PyFloat_AsDouble(value) : 0.0;
}

static long whole(PyObject *value)
{
    return value ? PyLong_AsLong(value) : 0;
}

static PyObject *part(PyObject *value, Py_ssize_t at)
{
    return value && PyTuple_Check(value) && at < PyTuple_GET_SIZE(value) ? PyTuple_GET_ITEM(value, at) : NULL;
}

/* Fills what the next argument leads to; with 0 where there is no value. A pointer to nothing is left alone. */
static void fill(char letter, struct arguments *given, PyObject *value)
{
    void *at = va_arg(given->left, void *);
    if (!at)
        return;
    switch (letter) {
    case 'd':
        *(double *)at = number(value);
        break;
    case 'h':
        *(short *)at = (short)whole(value);
        break;
    case 'H':
        *(unsigned short *)at = (unsigned short)whole(value);
        break;
    case 'l':
        *(long *)at = whole(value);
        break;
    case 'L':
        *(unsigned long *)at = (unsigned long)whole(value);
        break;
    case 'P':
        for (Py_ssize_t i = 0; i < 4; i++)
            ((double *)at)[i] = number(part(value, i));
        break;
    case 'M':
        ((TLookAheadMsg *)at)->mtnNum = whole(part(value, 0));
        ((TLookAheadMsg *)at)->num = (short)whole(part(value, 1));
        ((TLookAheadMsg *)at)->error = (short)whole(part(value, 2));
        break;
    }
}

static PyObject *answer_of(Py_ssize_t index, const char **form, struct arguments *given)
{
    PyObject *values[MOST + 1], *answer = NULL;
    size_t count = 0, made = 0;
    for (; **form != '>'; (*form)++) {
        values[count] = taken(**form, given);
        made += values[count++] != NULL;
    }
    if (made == count)
        answer = called(index, values, count);
    while (count--)
        Py_XDECREF(values[count]);
    return answer;
}

/* Calls a function of the card. `form` has a letter for each argument: those that are given, >, those to be filled. */
static int drycut_call(int index, const char *form, ...)
{
    struct arguments given;
    struct visit visit;
    PyObject *answer = NULL, *code;
    int result = FAILED, in = enter(&visit);
    va_start(given.left, form);
    if (in) {
        answer = answer_of(index, &form, &given);
        code = part(answer, 0) ? part(answer, 0) : answer;
        if (code && PyLong_Check(code))
            result = (int)PyLong_AsLong(code);
    } else {
        for (; *form != '>'; form++)
            skip(*form, &given);
    }
    for (Py_ssize_t i = 1; *++form; i++)
        fill(*form, &given, part(answer, i));
    va_end(given.left);
    if (in) {
        if (PyErr_Occurred())
            result = FAILED, PyErr_Clear();
        Py_XDECREF(answer);
        leave(&visit);
    }
    return result;
}

/* Lets so many seconds pass on the card; -1 where that cannot be, as in what Python itself does. */
static int drycut_pass(double seconds)
{
    struct visit visit;
    PyObject *given, *answer = NULL;
    int result;
    if (inside || !enter(&visit))
        return FAILED;
    given = PyFloat_FromDouble(seconds);
    if (given)
        answer = called(card_functions + SLEEP, &given, 1);
    result = answer && answer != Py_None ? 0 : FAILED;
    PyErr_Clear();
    Py_XDECREF(given), Py_XDECREF(answer);
    leave(&visit);
    return result;
}

DRYCUT void drycut_sleep(unsigned long ms)
{
    struct timespec real = {(time_t)(ms / 1000), (long)(ms % 1000) * 1000000};
    while (ms == 0xFFFFFFFF) /* for ever */
        pause();
    if (drycut_pass((double)ms / 1000.0))
        nanosleep(&real, NULL);
}

DRYCUT unsigned long drycut_milliseconds(void)
{
    struct visit visit;
    struct timespec real;
    PyObject *answer;
    unsigned long ms;
    if (inside || !enter(&visit)) {
        clock_gettime(CLOCK_MONOTONIC, &real);
        return (unsigned long)real.tv_sec * 1000 + (unsigned long)real.tv_nsec / 1000000;
    }
    answer = called(card_functions + MILLISECONDS, NULL, 0);
    ms = answer ? PyLong_AsUnsignedLongMask(answer) : 0;
    PyErr_Clear();
    Py_XDECREF(answer);
    leave(&visit);
    return ms;
}

/* libdrycut_sleep, where the program has it, lets its sleeps pass on the card. */
__attribute__((constructor)) static void meet_sleeps(void)
{
    void (*let_pass)(int (*)(double)) = (void (*)(int (*)(double)))dlsym(RTLD_DEFAULT, "drycut_sleep_by");
    if (let_pass)
        let_pass(drycut_pass);
}

/* The functions of the card. */
