; Six boxes for five chutes: each diverter has at least one, the end of the line has one. Chute 2 wants b6 before b2, so
; b2 goes round.
(define (problem orders)
  (:domain sorting-line)
  (:objects
    b1 b2 b3 b4 b5 b6 nobody - box
    n1 n2 n3 n4 n5 n6 n7 - place
    in r d1 d2 d3 d4 e t1 t - zone
    c1 c2 c3 c4 c5 - chute)
  (:init
    (safe)
    (infeed in) (reads r)
    (leads in r) (leads r d1) (leads d1 d2) (leads d2 d3) (leads d3 d4) (leads d4 e) (leads t1 t)
    (crosses e t1) (crosses t r)
    (diverts d1 c1) (diverts d2 c2) (diverts d3 c3) (diverts d4 c4) (ends e c5)
    (links in r) (links r d1) (links d1 d2) (links d2 d3) (links d3 d4) (links d4 e) (links t1 t) (links e t1) (links t r)
    (leaves d1 c1) (leaves d2 c2) (leaves d3 c3) (leaves d4 c4) (leaves e c5)
    (free in) (free r) (free d1) (free d2) (free d3) (free d4) (free e) (free t1) (free t)
    (next n1)
    (announced b1 n1) (announced b2 n2) (announced b3 n3) (announced b4 n4) (announced b5 n5) (announced b6 n6)
    (follows n2 n1) (follows n3 n2) (follows n4 n3) (follows n5 n4) (follows n6 n5) (follows n7 n6)
    (wanted b1 c4) (wanted b2 c2) (wanted b3 c1) (wanted b4 c3) (wanted b5 c5) (wanted b6 c2)
    (turn b1 nobody) (turn b2 b6) (turn b3 nobody) (turn b4 nobody) (turn b5 nobody) (turn b6 nobody)
    (sorted nobody)
    (= (number b1) 1) (= (number b2) 2) (= (number b3) 3) (= (number b4) 4) (= (number b5) 5) (= (number b6) 6)
    (= (number nobody) 0)
    (= (shown in) 0) (= (shown r) 0) (= (shown d1) 0) (= (shown d2) 0) (= (shown d3) 0) (= (shown d4) 0) (= (shown e) 0)
    (= (shown t1) 0) (= (shown t) 0)
    (= (got c1) 0) (= (got c2) 0) (= (got c3) 0) (= (got c4) 0) (= (got c5) 0)
    (= (entered c1) 0) (= (entered c2) 0) (= (entered c3) 0) (= (entered c4) 0) (= (entered c5) 0)
    (= (distance in r) 1) (= (distance r d1) 1) (= (distance d1 d2) 1) (= (distance d2 d3) 1) (= (distance d3 d4) 1)
    (= (distance d4 e) 1) (= (distance e t1) 1) (= (distance t1 t) 5) (= (distance t r) 1)
    (= (travel) 0))
  (:goal (and (sorted b1) (sorted b2) (sorted b3) (sorted b4) (sorted b5) (sorted b6)))
  (:metric minimize (travel)))
