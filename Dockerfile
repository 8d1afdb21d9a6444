# drycut with all extras; docker build -t drycut . && docker run --rm -v "$PWD:/work" drycut check .
FROM python:3.11-slim AS build
COPY . /source
RUN python -m venv /opt/drycut \
 && /opt/drycut/bin/pip install --no-cache-dir --require-hashes --requirement /source/requirements-all-lock.txt \
 && /opt/drycut/bin/pip install --no-cache-dir --require-hashes --requirement /source/requirements-build-lock.txt \
 && /opt/drycut/bin/pip install --no-cache-dir --no-deps --no-build-isolation /source \
 && NUMBA_CACHE_DIR=/opt/drycut/loops /opt/drycut/bin/python -m sim.cli.compile

FROM python:3.11-slim
COPY --from=build /opt/drycut /opt/drycut
RUN useradd --create-home drycut
USER drycut
ENV PATH=/opt/drycut/bin:$PATH PYTHONUTF8=1 NUMBA_CACHE_DIR=/opt/drycut/loops
WORKDIR /work
ENTRYPOINT ["drycut"]
