# The programs on Debian 12, from the package that scripts/packages leaves in build/packages:
#   docker build -t regrasp . && docker run --rm -v "$PWD:/work" regrasp validate --object … --plan …
FROM debian:bookworm-slim
COPY build/packages/regrasp_*.deb /tmp/
RUN apt-get update && apt-get install -y --no-install-recommends /tmp/regrasp_*.deb \
    && rm -rf /tmp/*.deb /var/lib/apt/lists/*
WORKDIR /work
ENTRYPOINT ["regrasp"]
