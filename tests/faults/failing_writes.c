/* Preloaded, it lets the n-th write below a folder fail, and all after it, as a full or a broken disk does.
 *
 *   VANTAGE_FAULT_UNDER  the folder
 *   VANTAGE_FAULT_AT     n, from 1; 0: none fails
 *   VANTAGE_FAULT_ERRNO  the error's number
 *   VANTAGE_FAULT_ONCE   set: only the n-th fails
 *   VANTAGE_FAULT_COUNT  file that the number of writes is written to when the program ends
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

static atomic_long writes;

static long number_of(const char* name) {
  const char* text = getenv(name);
  return text != NULL ? strtol(text, NULL, 10) : 0;
}

static int is_under(const char* path) {
  const char* folder = getenv("VANTAGE_FAULT_UNDER");
  return folder != NULL && strncmp(path, folder, strlen(folder)) == 0;
}

static int is_file_under(int descriptor) {
  char link[64];
  char path[PATH_MAX + 1];
  const int before = errno;
  snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  const ssize_t length = readlink(link, path, PATH_MAX);
  errno = before;
  if (length <= 0) return 0;
  path[length] = '\0';
  return is_under(path);
}

/* Counts one write; 1 with errno set if it is to fail. */
static int fails(void) {
  const long at = number_of("VANTAGE_FAULT_AT");
  const long now = atomic_fetch_add(&writes, 1) + 1;
  if (at == 0 || now < at || (now > at && getenv("VANTAGE_FAULT_ONCE") != NULL)) return 0;
  errno = (int)number_of("VANTAGE_FAULT_ERRNO");
  return 1;
}

static void* next(const char* name) { return dlsym(RTLD_NEXT, name); }

ssize_t write(int descriptor, const void* bytes, size_t size) {
  static ssize_t (*real)(int, const void*, size_t);
  if (real == NULL) *(void**)&real = next("write");
  if (is_file_under(descriptor) && fails()) return -1;
  return real(descriptor, bytes, size);
}

ssize_t writev(int descriptor, const struct iovec* parts, int count) {
  static ssize_t (*real)(int, const struct iovec*, int);
  if (real == NULL) *(void**)&real = next("writev");
  if (is_file_under(descriptor) && fails()) return -1;
  return real(descriptor, parts, count);
}

size_t fwrite(const void* bytes, size_t size, size_t count, FILE* stream) {
  static size_t (*real)(const void*, size_t, size_t, FILE*);
  if (real == NULL) *(void**)&real = next("fwrite");
  if (is_file_under(fileno(stream)) && fails()) return 0;
  return real(bytes, size, count, stream);
}

int fsync(int descriptor) {
  static int (*real)(int);
  if (real == NULL) *(void**)&real = next("fsync");
  if (is_file_under(descriptor) && fails()) return -1;
  return real(descriptor);
}

int rename(const char* from, const char* to) {
  static int (*real)(const char*, const char*);
  if (real == NULL) *(void**)&real = next("rename");
  if (is_under(to) && fails()) return -1;
  return real(from, to);
}

static int opens_to_write(const char* path, int flags) {
  return (flags & O_CREAT) != 0 && is_under(path);
}

int open(const char* path, int flags, ...) {
  static int (*real)(const char*, int, ...);
  va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
  va_end(more);
  if (real == NULL) *(void**)&real = next("open");
  if (opens_to_write(path, flags) && fails()) return -1;
  return real(path, flags, mode);
}

FILE* fopen(const char* path, const char* mode) {
  static FILE* (*real)(const char*, const char*);
  if (real == NULL) *(void**)&real = next("fopen");
  if (strchr(mode, 'r') == NULL && is_under(path) && fails()) return NULL;
  return real(path, mode);
}

FILE* fopen64(const char* path, const char* mode) { return fopen(path, mode); }

__attribute__((destructor)) static void tell(void) {
  const char* file = getenv("VANTAGE_FAULT_COUNT");
  if (file == NULL) return;
  FILE* stream = fopen(file, "a");
  if (stream == NULL) return;
  fprintf(stream, "%ld\n", atomic_load(&writes));
  fclose(stream);
}
